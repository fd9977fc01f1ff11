#include "curved_walls.h"

namespace {

using namespace test;

/// Markers on a tube along x of the radius wide - depth (1 - cos(2 pi x / length)) / 2, or
/// `outside` beyond it; with areas times normals in the place of forces.
struct Throat {
  double wide, depth;

  double radius(double x, double length) const
  {
    return wide - 0.5 * depth * (1 - std::cos(2 * pi * x / length));
  }

  Points points(const Grid &grid, double outside, double spacing) const
  {
    const double length = grid.cells[0];
    const int rings = static_cast<int>(std::lround(length / spacing));
    Points points;
    for (int ring = 0; ring < rings; ++ring) {
      const double x = length * (ring + 0.3) / rings, r = radius(x, length);
      const double slope = -pi * depth / length * std::sin(2 * pi * x / length);
      const double cosine = 1 / std::hypot(1, slope);
      const int around = static_cast<int>(std::lround(2 * pi * r / spacing));
      for (int n = 0; n < around; ++n) {
        const double angle = 2 * pi * (n + 0.5 * (ring % 2)) / around;
        const Real3 normal{-slope * cosine, cosine * std::cos(angle), cosine * std::sin(angle)};
        const double area = 2 * pi * r / around * length / rings / cosine;
        points.position.push_back(
            {x + outside * normal[0],
             0.5 * grid.cells[1] + r * std::cos(angle) + outside * normal[1],
             0.5 * grid.cells[2] + r * std::sin(angle) + outside * normal[2]});
        points.force.push_back({area * normal[0], area * normal[1], area * normal[2]});
      }
    }
    return points;
  }
};

/// Rate at which fluid crosses the wall, in and out, relative to that along the tube.
double leakage(Scene &scene, const Throat &throat)
{
  const Grid &grid = scene.flow.grid();
  Points wall = throat.points(grid, 0, 0.8);
  assign(wall, grid, scene.flow.decomposition());
  std::vector<Real3> u(wall.count());
  scene.flow.interpolate(wall.markers(scene.kernel), numbers(u));
  double through = 0;
  for (int n : wall.index)
    through += std::abs(u[n][0] * wall.force[n][0] + u[n][1] * wall.force[n][1] +
                        u[n][2] * wall.force[n][2]);
  return sum(through) / flow_rates(scene, throat.wide)[0];
}

/// A force density in a tube, straight or with a throat of half the width, which is 14 and 28 cells
/// wide.
double leakage(KernelKind kernel, double wide, double depth)
{
  const Throat throat{wide, depth};
  const Grid grid = around_tube(wide, 3 * wide);
  Scene scene(grid, even(grid, {1, 1, ranks()}), kernel,
              {throat.points(grid, surface_offset(kernel), 1.2)}, true, 1e-4);
  scene.solve(
      [&](int c, const Real3 &x) {
        return c == 0 && from_axis(grid, x) < throat.radius(x[0], grid.cells[0]) ? 1.0 : 0.0;
      },
      at_rest);
  return leakage(scene, throat);
}

TEST(RigidVessel, Leakage)
{
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3}) {
    EXPECT_LT(leakage(kernel, 14, 0), 1e-3);
    const double coarse = leakage(kernel, 14, 7), fine = leakage(kernel, 28, 14);
    std::printf("throat: %.4f of the flow crosses its wall, %.4f on a grid twice as fine\n", coarse,
                fine);
    EXPECT_GT(order(coarse, fine), 0.9);
  }
}

/// Radii in cells; 14.0625 is that of a tube of 22.5 um at 0.8 um.
TEST(RigidVessel, PoiseuilleFlow)
{
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3}) {
    const PoiseuilleError coarse = poiseuille(kernel, 7.03125), fine = poiseuille(kernel, 14.0625);
    std::printf("flow rate in a tube: off by %.4f, %.4f on a grid twice as fine\n", coarse.rate,
                fine.rate);
    EXPECT_LT(std::abs(coarse.rate), 0.03);
    EXPECT_LT(std::abs(fine.rate), 0.006);
    EXPECT_LT(std::abs(fine.rate), 0.4 * std::abs(coarse.rate));
    EXPECT_LT(std::max(coarse.leakage, fine.leakage), 1e-4);
  }
}

/// Sheets need no offset, whether there is flow on one side or on both. Points cannot do the
/// second.
TEST(RigidVessel, PoiseuilleFlowBetweenSheets)
{
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (bool everywhere : {false, true})
      for (double radius : {7.03125, 14.0625}) {
        const PoiseuilleError error = poiseuille(kernel, radius, MarkerKind::sheets, everywhere);
        std::printf("flow rate between sheets, kernel %d, everywhere %d, radius %g: off by %.4f\n",
                    static_cast<int>(kernel), everywhere, radius, error.rate);
        EXPECT_LT(std::abs(error.rate), everywhere ? 0.01 : 0.06 / radius);
        EXPECT_LT(error.leakage, 1e-4);
      }
}

TEST(RigidVessel, SphereOnTheAxisOfATube)
{
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (const auto &[share, k1, k2] : tube_factors) {
      if (kernel == KernelKind::roma3 && share < 0.6) continue;
      const bool small = share < 0.2;
      const double radius = small ? 32 : 16;
      const TubeFactors found = found_factors(
          kernel, MarkerKind::points, (small ? 3 : 5) * radius, {radius, share * radius},
          {radius + surface_offset(kernel), dilute_radius(kernel, share * radius)});
      EXPECT_NEAR(found.k2 / found.k1, k2 / k1, 0.005 * k2 / k1) << share;
      EXPECT_NEAR(found.k1, k1, 0.06 * k1) << share;
    }
}

/// Points, with the offset of a plane, are 5 to 13 % off. What is left is of third order in the gap
/// between sphere and tube, 8 and 4.8 cells wide.
TEST(RigidVessel, SheetsOfASphereOnTheAxisOfATube)
{
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (const auto &[share, k1, k2] : tube_factors) {
      if (share < 0.4) continue;
      const TubeAndSphere radii{16, share * 16};
      const TubeFactors found = found_factors(kernel, MarkerKind::sheets, 80, radii, radii);
      const double part = (kernel == KernelKind::roma3 ? 1.5 : 2.5) / std::pow(16 * (1 - share), 3);
      std::printf("sheets of a sphere in a tube, kernel %d, a/R %g: off by %.4f, %.4f\n",
                  static_cast<int>(kernel), share, found.k1 / k1 - 1, found.k2 / k2 - 1);
      EXPECT_NEAR(found.k1, k1, part * k1) << share;
      EXPECT_NEAR(found.k2, k2, part * k2) << share;
    }
}

/// Mean of the solves of an evaluation in a tube in which a force moves along the wall, as of a
/// cell.
double mean_solves(double radius, double spacing, bool moves)
{
  const Grid grid = around_tube(radius, 2 * radius);
  const double markers = radius + surface_offset(KernelKind::peskin4);
  Scene scene(grid, even(grid, {1, 1, ranks()}), KernelKind::peskin4,
              {tube(grid, markers, spacing)}, true, 1e-3);
  constexpr int evaluations = 40;
  int solves = 0;
  for (int n = 0; n < evaluations; ++n) {
    const double at = moves ? 0.5 + 0.1 * n * radius / 14 : 5;
    const Real3 x0{at, 0.5 * grid.cells[1] + 0.75 * radius, 0.5 * grid.cells[2]};
    const auto force = [&](int c, const Real3 &x) {
      const double square =
          std::pow(x[0] - x0[0], 2) + std::pow(x[1] - x0[1], 2) + std::pow(x[2] - x0[2], 2);
      const double cell = std::exp(-square / (0.01 * radius * radius));
      return (c == 0 && from_axis(grid, x) < radius ? 1.0 : 0.0) + (c == 1 ? 20 : -10) * cell;
    };
    const auto outcome = scene.solve(force, at_rest, n);
    EXPECT_LT(outcome.slip, 1e-3);
    if (!moves && n > 0) {
      EXPECT_EQ(outcome.solves, 1);
    }
    solves += outcome.solves;
  }
  return double(solves) / evaluations;
}

TEST(RigidVessel, SolvesOfAnEvaluation)
{
  const double steady = mean_solves(14, 1.2, false), base = mean_solves(14, 1.2, true);
  const double closer = mean_solves(14, 0.6, true), finer = mean_solves(28, 1.2, true);
  std::printf(
      "steady %.3f, moving force %.3f, markers twice as close %.3f, grid twice as fine %.3f\n",
      steady, base, closer, finer);
  EXPECT_LT(steady, 1.5);
  EXPECT_LT(base, 4);
  EXPECT_LT(closer, 1.3 * base);
  EXPECT_LT(finer, 1.3 * base);
}

}    // namespace
