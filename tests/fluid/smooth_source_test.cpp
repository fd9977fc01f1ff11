// Where fluid enters and leaves: the torsion function and what is made of it.

#include "fluid/smooth_source.h"

#include "fluid/torsion.h"
#include "test_support.h"

using namespace test;

namespace {

std::vector<std::int64_t> cells_in(const Grid &grid, const std::function<bool(const Real3 &)> &part)
{
  std::vector<std::int64_t> cells;
  for_each(grid.domain(), [&](int i, int j, int k) {
    if (part(location(grid, centre, i, j, k))) cells.push_back(grid.domain().offset(i, j, k));
  });
  return cells;
}

/// Of a layer of n planes, across periodic sides as well: (m + 1) (n - m) h^2 / 2 in plane m.
TEST(Torsion, OfALayerIsAParabola)
{
  const Grid grid{{4, 3, 12}, {0, 0, 0}, {0.7, 1, 0.5}, false};
  const std::function<bool(const Real3 &)> layer = [](const Real3 &x) {
    return x[2] < 2 || x[2] > 5;
  };
  const std::vector<std::int64_t> cells = cells_in(grid, layer);
  const std::vector<double> w = torsion_function(grid, cells);
  ASSERT_EQ(w.size(), 12u * 6);
  for (std::size_t m = 0; m < w.size(); ++m) {
    const int plane = int(cells[m] / 12 + 2) % 12;
    EXPECT_NEAR(w[m], (plane + 1) * (6 - plane) * 0.125, 1e-9);
  }
}

TEST(Torsion, PlatesPartWhatPeriodicSidesJoin)
{
  Grid grid{{4, 3, 12}, {0, 0, 0}, {0.7, 1, 0.5}, true};
  const auto cells = cells_in(grid, [](const Real3 &x) { return x[2] < 2 || x[2] > 5; });
  const std::vector<double> w = torsion_function(grid, cells);
  for (std::size_t m = 0; m < w.size(); ++m) {
    const int plane = int(cells[m] / 12);
    const double expected = plane < 4 ? (plane + 1) * (4 - plane) : (plane - 9) * (12 - plane);
    EXPECT_NEAR(w[m], expected * 0.125, 1e-9);
  }
}

/// Of a round bar: (R^2 - r^2) / 4, and its integral pi R^4 / 8.
TEST(Torsion, OfARoundBarIsPoiseuilleFlow)
{
  const double radius = 5;
  double worst[2];
  for (int fine = 0; fine < 2; ++fine) {
    const double h = fine ? 0.25 : 0.5;
    const int n = static_cast<int>(12 / h);
    const Grid grid{{2, n, n}, {0, 0, 0}, {h, h, h}, false};
    const auto cells =
        cells_in(grid, [&](const Real3 &x) { return std::hypot(x[1] - 6, x[2] - 6.01) < radius; });
    const std::vector<double> w = torsion_function(grid, cells);
    double total = 0;
    for (double value : w) total += value * h * h / 2;
    worst[fine] = std::abs(total / (pi * std::pow(radius, 4) / 8) - 1);
  }
  // it is zero in the next centres beyond the surface, half a cell away from it in the mean
  EXPECT_LT(worst[0], 4 * 0.25 / radius);
  EXPECT_LT(worst[1], 0.6 * worst[0]);
}

/// The same on all layouts, of the rate asked for.
TEST(SmoothSource, GivesItsRate)
{
  const Grid grid{{12, 10, 14}, {-1, 0.3, 2}, {1, 0.8, 1.3}, false};
  const auto ball = [](const Real3 &x) {
    return std::hypot(x[0] - 4, x[1] - 4.3, x[2] - 10) < 3.5;
  };
  const auto all = alone(grid);
  const SmoothSource reference(grid, all, ball);
  ScalarField expected(grid.domain());
  reference.add(-2.5, expected);
  for (const Layout &layout : layouts(grid)) {
    const SmoothSource source(grid, layout.decomposition, ball);
    const Box &brick = layout.decomposition.mine();
    ScalarField supply(brick), ones(brick), radius(brick);
    source.add(-2.5, supply);
    double total = 0;
    Error error;
    for_each(brick, [&](int i, int j, int k) {
      total += supply[0](i, j, k) * grid.cell_volume();
      error.add(supply[0](i, j, k) - expected[0](i, j, k));
      ones[0](i, j, k) = 1;
      const Real3 x = location(grid, centre, i, j, k);
      radius[0](i, j, k) = std::hypot(x[0] - 4, x[1] - 4.3, x[2] - 10);
      const bool inside = ball(location(grid, centre, i, j, k));
      EXPECT_EQ(supply[0](i, j, k) < 0, inside);
    });
    EXPECT_NEAR(sum(total), -2.5, 1e-13);
    EXPECT_EQ(error.over_ranks().largest, 0);
    EXPECT_NEAR(source.core_mean(ones, MPI_COMM_WORLD), 1, 1e-13);
    // of r^2 (R^2 - r^2), r below R / sqrt(2): 0.505 R, R up to half a cell larger
    EXPECT_NEAR(source.core_mean(radius, MPI_COMM_WORLD), 0.505 * 3.75, 0.505 * 0.25);
    EXPECT_EQ(source.volume(), reference.volume());
    EXPECT_NEAR(source.volume() / (4 * pi / 3 * std::pow(3.5, 3)), 1, 0.06);
  }
}

/// The second moments grow by the variance, and the rate stays.
TEST(SmoothSource, IsSpreadFurther)
{
  const Grid grid{{12, 10, 14}, {-1, 0.3, 2}, {1, 0.8, 1.3}, true};
  const Decomposition bricks = even(grid, {1, ranks(), 1});
  const Real3 middle{5.5, 4.7, 10.45};    // of a cell
  const auto part = [&](const Real3 &x) {
    return std::hypot(x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]) < 2.5;
  };
  Real3 moments[2];
  for (int spread = 0; spread < 2; ++spread) {
    const SmoothSource source(grid, bricks, part, spread ? 0.3 : 0);
    ScalarField supply(bricks.mine());
    source.add(1, supply);
    double total = 0;
    Real3 &moment = moments[spread] = {0, 0, 0};
    for_each(bricks.mine(), [&](int i, int j, int k) {
      const double share = supply[0](i, j, k) * grid.cell_volume();
      const Real3 x = location(grid, centre, i, j, k);
      total += share;
      for (int d = 0; d < 3; ++d) moment[d] += share * (x[d] - middle[d]) * (x[d] - middle[d]);
    });
    EXPECT_NEAR(sum(total), 1, 1e-13);
    reduce(MPI_SUM, moment[0], moment[1], moment[2]);
  }
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(moments[1][d] - moments[0][d], 0.3 * grid.spacing[d] * grid.spacing[d], 1e-13);
}

/// What would get through a plate stays at it.
TEST(SmoothSource, DoesNotPassAPlate)
{
  const Grid grid{{4, 4, 6}, {0, 0, 0}, {1, 1, 1}, true};
  const Decomposition bricks = even(grid, {1, 1, ranks()});
  const SmoothSource source(
      grid, bricks, [](const Real3 &x) { return x[2] < 2; }, 0.3);
  ScalarField supply(bricks.mine());
  source.add(2, supply);
  double total = 0, beyond = 0;
  for_each(bricks.mine(), [&](int i, int j, int k) {
    total += supply[0](i, j, k);
    if (k > 2) beyond += std::abs(supply[0](i, j, k));
  });
  EXPECT_NEAR(sum(total), 2, 1e-13);
  EXPECT_EQ(sum(beyond), 0);
}

TEST(SmoothSource, MayHoldNoCell)
{
  const Grid grid{{4, 4, 4}, {0, 0, 0}, {1, 1, 1}, false};
  const SmoothSource source(grid, even(grid, {1, 1, ranks()}), [](const Real3 &) { return false; });
  EXPECT_EQ(source.volume(), 0);
}

}    // namespace
