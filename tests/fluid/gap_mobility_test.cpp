// Surfaces that slide past each other in gaps narrower than the grid: what the grid gives and what
// GapMobility adds are together what the fluid between them allows.

#include "fluid/gap_mobility.h"

#include "fluid/flow.h"
#include "rigid_scene.h"
#include "test_support.h"

namespace {

using namespace test;

constexpr KernelKind kernels[] = {KernelKind::peskin4, KernelKind::roma3};
constexpr double gaps[] = {0.1, 0.2, 0.3, 0.5, 0.75, 1, 1.25, 1.5, 2};

std::vector<Real3> sheet_velocities(const Grid &grid, KernelKind kernel, Points points)
{
  constexpr int ghost_layers = 6;
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), ghost_layers, FlowEquations{});
  assign(points, grid, flow.decomposition());
  flow.clear_force();
  EXPECT_EQ(flow.spread(points.markers(kernel, MarkerKind::sheets), points.f(), 1), -1);
  flow.accumulate_ghosts();
  flow.solve();
  flow.fill_ghosts();
  std::vector<Real3> velocity(points.count(), {0, 0, 0});
  flow.interpolate(points.markers(kernel, MarkerKind::sheets), numbers(velocity));
  MPI_Allreduce(MPI_IN_PLACE, numbers(velocity), 3 * points.count(), MPI_DOUBLE, MPI_SUM,
                MPI_COMM_WORLD);
  return velocity;
}

/// Adds a plane of unit tractions along x to points on a grid of 4 x 4 unit cells across.
void add_plane(Points &points, double z, double traction)
{
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      points.position.push_back({i + 0.3, j + 0.6, z});
      points.force.push_back({traction, 0, 0});
    }
}

/// Friction, traction over the speed of sliding, times the gap over viscosity, of two planes far
/// from plates: with what is added, and as the grid has it.
struct Friction {
  double corrected, grid;
};

Friction friction_of_planes(KernelKind kernel, double gap)
{
  const Grid grid{{4, 4, 24}, {0, 0, 0}, {1, 1, 1}, true};
  constexpr int places = 20;
  double slide = 0;
  for (int place = 0; place < places; ++place) {
    Points planes;
    const double z = 11 + (place + 0.5) / places;
    add_plane(planes, z, -1);
    add_plane(planes, z + gap, 1);
    const auto velocity = sheet_velocities(grid, kernel, planes);
    slide += (velocity.back()[0] - velocity.front()[0]) / places;
  }
  slide += gap * gap / 24;    // what the plates hold back
  return {gap / (slide + GapMobility(kernel).slide(gap)), gap / slide};
}

TEST(GapMobility, Planes)
{
  for (KernelKind kernel : kernels)
    for (double gap : gaps) {
      const Friction friction = friction_of_planes(kernel, gap);
      std::printf("planes, kernel %d, gap %.2f dx: friction %.3f, without %.2f\n",
                  static_cast<int>(kernel), gap, friction.corrected, friction.grid);
      EXPECT_NEAR(friction.corrected, 1,
                  0.11);    // direction of the largest difference from the mean
    }
}

/// The velocity of a sheet beside a plate is that of Couette flow.
TEST(GapMobility, BesidePlate)
{
  constexpr int height = 24;
  const Grid grid{{4, 4, height}, {0, 0, 0}, {1, 1, 1}, true};
  for (KernelKind kernel : kernels) {
    const GapMobility missing(kernel);
    for (double gap : gaps) {
      Points plane;
      add_plane(plane, gap, 1);
      const double velocity = sheet_velocities(grid, kernel, plane)[0][0];
      const double exact = gap * (1 - gap / height);
      std::printf("plate, kernel %d, gap %.2f dx: friction %.3f, without %.2f\n",
                  static_cast<int>(kernel), gap, exact / (velocity + missing.slide_at_plate(gap)),
                  exact / velocity);
      EXPECT_NEAR(exact / (velocity + missing.slide_at_plate(gap)), 1, 0.06);
    }
  }
}

/// Velocity of a plane of unit tractions at a distance from a wall of markers at z, which are at
/// rest. The markers are points, the offset behind the wall.
double velocity_beside_wall(const Grid &grid, KernelKind kernel, double z, double distance)
{
  constexpr int ghost_layers = 6;
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), ghost_layers, FlowEquations{});
  Points wall, plane;
  add_plane(wall, z - surface_offset(kernel), 0);
  add_plane(plane, z + distance, 1);
  for (Points *points : {&wall, &plane}) assign(*points, grid, flow.decomposition());
  const auto rows = rows_here(wall.position, wall);
  const std::vector<int> body(wall.index.size(), 0);
  RigidSurface surface;
  RigidSurface::Settings settings;
  settings.tolerance = 1e-8;
  settings.max_solves = 300;
  surface.set_settings(settings);
  surface.set_markers(flow, kernel, static_cast<int>(body.size()), rows.data(), body.data());
  std::fill_n(surface.target(), 3 * body.size(), 0.0);

  flow.clear_force();
  EXPECT_EQ(flow.spread(plane.markers(kernel, MarkerKind::sheets), plane.f(), 1), -1);
  EXPECT_EQ(surface.spread(flow, 0, {0, 0, 0}), -1);
  flow.accumulate_ghosts();
  flow.solve();
  EXPECT_TRUE(surface.enforce(flow).converged);
  std::vector<Real3> velocity(plane.count(), {0, 0, 0});
  flow.interpolate(plane.markers(kernel, MarkerKind::sheets), numbers(velocity));
  MPI_Allreduce(MPI_IN_PLACE, numbers(velocity), 3 * plane.count(), MPI_DOUBLE, MPI_SUM,
                MPI_COMM_WORLD);
  return velocity[0][0];
}

/// Beside a wall of points that are the offset behind it little is missing: sheets are further from
/// the points than from the wall. Across an axis the difference is largest.
TEST(GapMobility, BesideWallOfPoints)
{
  constexpr int height = 24, places = 4;
  const Grid grid{{4, 4, height}, {0, 0, 0}, {1, 1, 1}, true};
  for (KernelKind kernel : kernels)
    for (double gap : {0.2, 0.3, 0.5, 1.0, 2.0}) {
      double velocity = 0, exact = 0;
      for (int place = 0; place < places; ++place) {
        const double z = 10 + (place + 0.5) / places;
        velocity += velocity_beside_wall(grid, kernel, z, gap) / places;
        exact += gap * (1 - gap / (height - z)) / places;
      }
      std::printf("wall, kernel %d, gap %.2f dx: friction %.3f\n", static_cast<int>(kernel), gap,
                  exact / velocity);
      EXPECT_NEAR(exact / velocity, 1, kernel == KernelKind::roma3 ? 0.2 : 0.14);
    }
}

/// Adds a sphere with the torque `torque` about z on the fluid.
void add_sphere(Points &points, const Real3 &centre, double radius, double torque)
{
  const Points sphere = test::sphere(centre, radius, 0.6);
  double moment = 0;
  for (const Real3 &x : sphere.position)
    moment += std::pow(x[0] - centre[0], 2) + std::pow(x[1] - centre[1], 2);
  for (const Real3 &x : sphere.position) {
    points.position.push_back(x);
    points.force.push_back(
        {-torque / moment * (x[1] - centre[1]), torque / moment * (x[0] - centre[0]), 0});
  }
}

/// Two concentric spheres that turn against each other: planes of all directions. The outer flow is
/// at rest, so that walls far away do not matter.
TEST(GapMobility, ConcentricSpheres)
{
  constexpr int n = 32;
  const Grid grid{{n, n, n}, {0, 0, 0}, {1, 1, 1}, false};
  const Real3 centre{n / 2 + 0.1, n / 2 + 0.2, n / 2 + 0.3};
  constexpr double inner = 8;
  for (KernelKind kernel : kernels) {
    const GapMobility missing(kernel);
    for (double gap : gaps) {
      const double outer = inner + gap;
      Points points;
      add_sphere(points, centre, inner, 1);
      const std::size_t first_outer = points.position.size();
      add_sphere(points, centre, outer, -1);
      const auto velocity = sheet_velocities(grid, kernel, points);
      double turned[2] = {0, 0}, moment[2] = {0, 0};
      for (std::size_t m = 0; m < velocity.size(); ++m) {
        const int which = m < first_outer ? 0 : 1;
        const double x = points.position[m][0] - centre[0], y = points.position[m][1] - centre[1];
        turned[which] += x * velocity[m][1] - y * velocity[m][0];
        moment[which] += x * x + y * y;
      }
      const double on_grid = turned[0] / moment[0] - turned[1] / moment[1];
      const double exact = (std::pow(inner, -3) - std::pow(outer, -3)) / (8 * pi);
      // traction 3 T / (8 pi a^3) sin(polar angle) on each; both speeds at the middle radius
      const double middle = (inner + outer) / 2;
      const double added = missing.slide(gap) * 3 / (8 * pi * std::pow(middle, 4));
      std::printf("spheres, kernel %d, gap %.2f dx: friction %.3f, without %.2f\n",
                  static_cast<int>(kernel), gap, exact / (on_grid + added), exact / on_grid);
      EXPECT_NEAR(exact / (on_grid + added), 1, gap < 1.5 ? 0.035 : 0.065);
    }
  }
}

}    // namespace
