// Flows left to themselves: the Taylor-Green vortex, and the energy of a flow with hardly any
// viscosity.

#include "flow_support.h"
#include "fluid/diagnostics.h"

using namespace test;

namespace {

constexpr double viscosity = 0.7, density = 1.3;

Grid cube(int n)
{
  return {{n, n, 4}, {0, 0, 0}, {2 * pi / n, 2 * pi / n, 0.3}, false};
}

/// sin x cos y, -cos x sin y: its discrete advection is a discrete gradient, so that it keeps its
/// shape.
double vortex(int c, const Real3 &x)
{
  if (c == 2) return 0;
  return c == 0 ? std::sin(x[0]) * std::cos(x[1]) : -std::cos(x[0]) * std::sin(x[1]);
}

void start(ForcedFlow &flow)
{
  flow.set_velocity(
      [&](int c, int i, int j, int k) { return vortex(c, location(flow.grid(), c, i, j, k)); });
}

/// Largest difference from the vortex times an amplitude.
double error(const ForcedFlow &flow, double amplitude)
{
  Error error;
  for_each(flow.brick(), [&](int i, int j, int k) {
    for (int c = 0; c < 3; ++c)
      error.add(flow.velocity()[c](i, j, k) -
                amplitude * vortex(c, location(flow.grid(), c, i, j, k)));
  });
  return error.over_ranks().largest;
}

TEST(TaylorGreenVortex, DecaysByTheFactorOfTheScheme)
{
  const Grid grid = cube(8);
  const double h = grid.spacing[0], kappa = 2 * std::sin(h / 2) / h;
  for (Inertia inertia : {Inertia::unsteady, Inertia::convective}) {
    ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 0,
                    FlowEquations{viscosity, density, inertia});
    start(flow);
    double amplitude = 1;
    for (int n = 0; n < 12; ++n) {
      const double dt = n % 3 ? 0.05 : 0.2;
      const double a = viscosity / density * kappa * kappa * dt;    // nu (kx^2 + ky^2) dt / 2
      step(flow, dt);
      amplitude *= n < 2 ? 1 / ((1 + a) * (1 + a)) : (1 - a) / (1 + a);
      EXPECT_LT(error(flow, amplitude), 1e-14) << "step " << n;
    }
  }
}

TEST(TaylorGreenVortex, DecaysWithSecondOrder)
{
  const auto error_at_end = [](int n) {
    const Grid grid = cube(n);
    ForcedFlow flow(grid, even(grid, {1, ranks(), 1}), 0,
                    FlowEquations{viscosity, density, Inertia::convective});
    start(flow);
    const double duration = 1;
    for (int s = 0; s < n; ++s) step(flow, duration / n);
    return error(flow, std::exp(-2 * viscosity / density * duration));
  };
  EXPECT_NEAR(order(error_at_end(16), error_at_end(32)), 2, 0.05);
}

/// The discrete advection conserves energy; what is gained or lost comes from the steps in time.
TEST(Energy, IsConservedWithoutViscosityButForTheTimeStep)
{
  for (bool walls : {false, true}) {
    const Grid grid{{8, 6, 8}, {0, 0, 0}, {0.5, 0.6, 0.7}, walls};
    const auto gain = [&](double dt) {
      ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1,
                      FlowEquations{1e-12, density, Inertia::convective});
      set_noise_velocity(flow, 3, 1);
      const double before = flow.diagnose().kinetic_energy_per_density;
      for (double t = 0; t < 1 - dt / 2; t += dt) step(flow, dt);
      return flow.diagnose().kinetic_energy_per_density / before - 1;
    };
    const double coarse = gain(1.0 / 80), fine = gain(1.0 / 160);
    EXPECT_NEAR(order(coarse, fine), 2, 0.1) << describe(grid);
    EXPECT_LT(std::abs(fine), 1e-4);
  }
}

}    // namespace
