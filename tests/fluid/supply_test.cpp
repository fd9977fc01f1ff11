// Fluid that appears and vanishes: div u = q.

#include "flow_support.h"
#include "fluid/plates.h"

using namespace test;

namespace {

constexpr double viscosity = 1.3;

/// A noisy supply and force, and what is left of the discrete equations.
class SuppliedFlow : public ForcedFlow {
 public:
  SuppliedFlow(const Grid &grid, const Decomposition &decomposition) :
      ForcedFlow(grid, decomposition, 1, FlowEquations{viscosity})
  {
    double total = 0;
    set(supply()[0], brick(), [&](int i, int j, int k) { return noise(7, i, j, k); });
    for_each(brick(), [&](int i, int j, int k) { total += supply()[0](i, j, k); });
    mean_ = sum(total) / double(grid.size());
    set_noise_force(*this, 3);
    solve();
  }

  double mean() const { return mean_; }

  double divergence()
  {
    const VectorField &u = fluid_velocity();
    Error error;
    for_each(brick(), [&](int i, int j, int k) {
      double divergence = 0;
      for (int d = 0; d < 3; ++d)
        divergence +=
            (u[d](i + (d == 0), j + (d == 1), k + (d == 2)) - u[d](i, j, k)) / grid().spacing[d];
      error.add(divergence - (supply()[0](i, j, k) - mean_));
    });
    return error.over_ranks().largest;
  }

  /// Of the momentum equation on faces whose neighbours are no plates.
  double momentum()
  {
    const VectorField &u = fluid_velocity();
    const ScalarField &pressure = this->pressure();
    Halo halo(grid(), decomposition(), 1);
    ScalarField p(halo.box());
    set(p[0], brick(), pressure[0]);
    halo.fill(p.views());
    const Real3 force = grid().plates ? Real3{0, 0, 0} : mean_force();
    Error error;
    for_each(brick(), [&](int i, int j, int k) {
      if (grid().plates && (k == 0 || k == grid().cells[2] - 1)) return;
      for (int c = 0; c < 3; ++c) {
        const Real3 h = grid().spacing;
        double residual = (p[0](i, j, k) - p[0](i - (c == 0), j - (c == 1), k - (c == 2))) / h[c] -
                          this->force()[c](i, j, k) + force[c];
        for (int d = 0; d < 3; ++d) {
          const int x = d == 0, y = d == 1, z = d == 2;
          residual -= viscosity / (h[d] * h[d]) *
                      (u[c](i + x, j + y, k + z) - 2 * u[c](i, j, k) + u[c](i - x, j - y, k - z));
        }
        error.add(residual);
      }
    });
    return error.over_ranks().largest;
  }

 private:
  double mean_ = 0;
};

TEST(Supply, SolvesTheDiscreteEquations)
{
  for (bool plates : {false, true}) {
    const Grid grid{{12, 10, 14}, {0, 0, 0}, {1, 0.8, 1.3}, plates};
    for (const Layout &layout : layouts(grid)) {
      SuppliedFlow flow(grid, layout.decomposition);
      EXPECT_LT(flow.divergence(), 1e-12) << describe(grid) << ' ' << layout.name;
      EXPECT_LT(flow.momentum(), 1e-12) << describe(grid) << ' ' << layout.name;
    }
  }
}

/// A supply cos(k x) in a box without forces drives the potential flow sin(k x) / k, and the
/// pressure viscosity cos(k x).
TEST(Supply, DrivesPotentialFlow)
{
  double worst[2];
  for (int fine = 0; fine < 2; ++fine) {
    const int n = 16 << fine;
    const Grid grid{{4, 4, n}, {0, 0, 0}, {0.5, 0.5, 2 * pi / n}, false};
    ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1, FlowEquations{viscosity});
    set(flow.supply()[0], flow.brick(),
        [&](int, int, int k) { return std::cos(location(grid, centre, 0, 0, k)[2]); });
    flow.solve();
    const ScalarField &pressure = flow.pressure();
    Error error;
    for_each(flow.brick(), [&](int i, int j, int k) {
      error.add(flow.velocity()[2](i, j, k) - std::sin(location(grid, 2, i, j, k)[2]));
      error.add(pressure[0](i, j, k) - viscosity * std::cos(location(grid, centre, i, j, k)[2]));
    });
    worst[fine] = error.over_ranks().largest;
  }
  EXPECT_LT(worst[0], 1e-2);
  EXPECT_NEAR(worst[0] / worst[1], 4, 0.1);
}

TEST(Supply, EndsAndMovesWithTheFlow)
{
  const Grid grid{{12, 10, 14}, {0, 0, 0}, {1, 0.8, 1.3}, false};
  SuppliedFlow flow(grid, even(grid, {1, 1, ranks()}));
  ForcedFlow other(grid, even(grid, {1, ranks(), 1}), 1, FlowEquations{viscosity});
  other.take_over(flow);
  EXPECT_NE(other.source(), nullptr);
  other.solve();
  const double error = other.diagnose().max_divergence * other.diagnose().max_speed / 0.8;
  EXPECT_NEAR(error, std::abs(flow.mean()), 1e-12);
  other.end_supply();
  EXPECT_EQ(other.source(), nullptr);
  other.solve();
  EXPECT_LT(other.diagnose().max_divergence, 1e-12);
}

/// Double layers ask for a divergence of their own.
TEST(Supply, AddsToThatOfDoubleLayers)
{
  const Grid grid{{16, 16, 16}, {0, 0, 0}, {1, 1, 1}, false};
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 5, FlowEquations{viscosity});
  Points points = scatter(grid, 40, 1);
  assign(points, grid, flow.decomposition());
  std::vector<Real3> velocity = points.force, strength = points.force;
  double before = 0;
  for (bool supplied : {false, true}) {
    if (supplied)
      set(flow.supply()[0], flow.brick(),
          [](int i, int j, int k) { return noise(7, i, j, k) - noise(7, i ^ 1, j, k); });
    flow.clear_force();
    const MarkerSet markers = points.markers(KernelKind::roma3);
    EXPECT_EQ(flow.spread(markers, DoubleLayer{numbers(velocity), numbers(strength)}), -1);
    flow.accumulate_ghosts();
    flow.solve();
    Error source;
    for_each(flow.brick(), [&](int i, int j, int k) { source.add((*flow.source())[0](i, j, k)); });
    const FlowDiagnostics now = flow.diagnose();
    if (!supplied) before = now.max_divergence * now.max_speed;
    EXPECT_GT(source.over_ranks().largest, 0.1);
    EXPECT_NEAR(now.max_divergence * now.max_speed, before, 1e-12);
  }
}

}    // namespace
