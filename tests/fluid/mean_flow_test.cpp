// The mean velocity of a triply periodic box: held, or free to follow the forces.

#include "flow_support.h"
#include "fluid/diagnostics.h"

using namespace test;

namespace {

constexpr double density = 1.3;

Grid periodic()
{
  return {{8, 6, 10}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, false};
}

FlowEquations equations(Inertia inertia, bool hold_mean)
{
  return {0.7, density, inertia, Scheme::coupled, hold_mean};
}

TEST(MeanFlow, IsHeldWhateverTheForces)
{
  const Grid grid = periodic();
  const Real3 mean{0.3, -0.2, 0.6}, later{-0.1, 0.4, 0.2};
  for (Inertia inertia : {Inertia::none, Inertia::unsteady, Inertia::convective}) {
    ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1, equations(inertia, true));
    flow.forcing.mean = mean;
    const auto expect = [&](const Real3 &expected) {
      const FlowDiagnostics measures = flow.diagnose();
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(measures.mean_velocity[c], expected[c], 1e-14);
      EXPECT_GT(measures.max_speed, 1);
    };
    set_noise_force(flow, 1, 100);
    if (inertia == Inertia::none) {
      flow.solve();
      expect(mean);
      continue;
    }
    for (int n = 0; n < 5; ++n) {
      set_noise_force(flow, n, 100);
      step(flow, 0.1);
      expect(mean);
    }
    Forcing end = flow.forcing;
    end.mean = later;
    step_to(flow, 0.1, end);
    expect(later);
  }
}

TEST(MeanFlow, FollowsTheForces)
{
  const Grid grid = periodic();
  for (Inertia inertia : {Inertia::unsteady, Inertia::convective}) {
    ForcedFlow flow(grid, even(grid, {1, ranks(), 1}), 1, equations(inertia, false));
    flow.forcing.body = {0.2, -0.1, 0.3};
    Real3 expected{0.1, 0.5, -0.2};
    flow.set_velocity([&](int c, int, int, int) { return expected[c]; });
    for (int n = 0; n < 5; ++n) {
      set_noise_force(flow, n);
      const double dt = n % 2 ? 0.1 : 0.3;
      Real3 force{};
      for (int c = 0; c < 3; ++c)
        for_each(flow.brick(), [&](int i, int j, int k) { force[c] += flow.force()[c](i, j, k); });
      reduce(MPI_SUM, force[0], force[1], force[2]);
      step(flow, dt);
      for (int c = 0; c < 3; ++c) {
        expected[c] += dt * (force[c] / grid.size() + flow.forcing.body[c]) / density;
        EXPECT_NEAR(flow.diagnose().mean_velocity[c], expected[c], 1e-14);
      }
    }
  }
}

}    // namespace
