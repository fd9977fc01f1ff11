// Means over a part of the box.

#include "fluid/interior.h"

#include "flow_support.h"
#include "fluid/diagnostics.h"

using namespace test;

namespace {

TEST(Interior, MeanOfALinearFlowIsThatAtTheCentre)
{
  const Real3 centre{1.9, 2.3, 3.1};
  const double radius = 1.6;
  const auto ball = [&](const Real3 &x) {
    return std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]) < radius;
  };
  double worst[2];
  for (int fine = 0; fine < 2; ++fine) {
    const int n = 8 << fine;
    const Grid grid{{2 * n, n, 2 * n},
                    {-1, 0.1, 0.2},
                    {0.4 / (1 << fine), 0.6 / (1 << fine), 0.4 / (1 << fine)},
                    false};
    ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1, FlowEquations{1});
    flow.set_velocity([&](int c, int i, int j, int k) {
      const double x = grid.origin[0] + (i + 0.5 * (c != 0)) * grid.spacing[0];
      const double y = grid.origin[1] + (j + 0.5 * (c != 1)) * grid.spacing[1];
      const double z = grid.origin[2] + (k + 0.5 * (c != 2)) * grid.spacing[2];
      return c == 0 ? 1 + 0.3 * y - 0.2 * x : c == 1 ? 0.5 * z : 0.2 * z - 2;
    });
    const Interior interior(grid, flow.decomposition(), ball);
    const Real3 mean = interior.mean_velocity(flow);
    worst[fine] = std::abs(interior.volume() / (4 * pi / 3 * radius * radius * radius) - 1);
    EXPECT_NEAR(mean[0], 1 + 0.3 * centre[1] - 0.2 * centre[0], 2e-3);
    EXPECT_NEAR(mean[1], 0.5 * centre[2], 2e-3);
    EXPECT_NEAR(mean[2], 0.2 * centre[2] - 2, 2e-3);
  }
  EXPECT_LT(worst[0], 5e-3);
  EXPECT_LT(worst[1], 2e-3);
}

TEST(Interior, OfAllIsTheMeanOfTheBox)
{
  const Grid grid{{8, 6, 10}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, true};
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1, FlowEquations{1});
  flow.forcing.plates.lower = {1, 2, 0};
  flow.forcing.body = {0.3, -0.2, 0};
  set_noise_force(flow, 1);
  flow.solve();
  const Interior interior(grid, flow.decomposition(), [](const Real3 &) { return true; });
  EXPECT_NEAR(interior.volume(), grid.size() * grid.cell_volume(), 1e-12);
  const Real3 mean = interior.mean_velocity(flow), expected = flow.diagnose().mean_velocity;
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(mean[c], expected[c], 1e-13);
}

TEST(Flow, MeanForceIsThatOfAllRanks)
{
  const Grid grid{{8, 6, 10}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, false};
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1, FlowEquations{1});
  for (int c = 0; c < 3; ++c)
    set(flow.force()[c], flow.brick(), [&](int i, int, int k) { return c + i + 10.0 * k; });
  const Real3 mean = flow.mean_force();
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], c + 3.5 + 45, 1e-12);
}

}    // namespace
