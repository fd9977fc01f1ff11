// Sheets of markers: they move with the fluid beside them.

#include "fluid/flow.h"
#include "fluid/kernel.h"
#include "rigid_sphere.h"
#include "test_support.h"

namespace {

using namespace test;

constexpr int width = 5;
constexpr KernelKind kernels[] = {KernelKind::peskin4, KernelKind::roma3};

/// Velocities of this rank's markers in a flow of unit viscosity that their forces drive.
std::vector<Real3> velocities(const Grid &grid, const Decomposition &decomposition,
                              KernelKind kernel, Points points, MarkerKind kind)
{
  ForcedFlow flow(grid, decomposition, width, FlowEquations{});
  assign(points, grid, decomposition);
  flow.clear_force();
  EXPECT_EQ(flow.spread(points.markers(kernel, kind), points.f(), 1), -1);
  flow.accumulate_ghosts();
  flow.solve();
  flow.fill_ghosts();
  std::vector<Real3> velocity(points.count(), {undefined, undefined, undefined});
  flow.interpolate(points.markers(kernel, kind), numbers(velocity));

  std::vector<Real3> response = velocity;
  ForcedFlow other(grid, decomposition, width, FlowEquations{});
  other.apply_mobility(points.markers(kernel, kind), points.f(), numbers(response));
  for (int n : points.index)
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(response[n][d], velocity[n][d], 1e-12);
  return velocity;
}

/// A plane of tangential forces between plates: Couette flow on both sides. Markers that are points
/// lag by the offset in the mean over the places of the plane. Sheets do not, but for what the
/// correction for planes across an axis differs from its mean over all directions, 1 and 5 %, and
/// the offset in one place from its mean.
TEST(Sheet, PlaneBetweenPlates)
{
  const Grid grid{{8, 8, 24}, {0, 0, 0}, {0.7, 0.7, 0.7}, true};
  for (KernelKind kernel : kernels) {
    constexpr int places = 40;
    double as_points = 0, as_sheet = 0, worst = 0;
    for (int place = 0; place < places; ++place) {
      const double z = 9.0 + (place + 0.5) / places;
      Points plane;
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) {
          plane.position.push_back({0.7 * (i + 0.1), 0.7 * (j + 0.7), 0.7 * z});
          plane.force.push_back({0.7 * 0.7, 0, 0});
        }
      const double exact = 0.7 / (1 / z + 1 / (24 - z));
      const auto error = [&](MarkerKind kind) {
        return (velocities(grid, alone(grid), kernel, plane, kind)[0][0] - exact) / 0.7;
      };
      as_points += error(MarkerKind::points) / places;
      as_sheet += error(MarkerKind::sheets) / places;
      worst = std::max(worst, std::abs(error(MarkerKind::sheets)));
    }
    EXPECT_NEAR(as_points, -surface_offset(kernel), 1e-3);
    EXPECT_NEAR(as_sheet, 0, 0.06 * surface_offset(kernel));
    EXPECT_LT(worst, 0.15 * surface_offset(kernel));
  }
}

/// Angular velocity, over the exact one, of a sphere of tractions that turn it, in a cubic array:
/// that of a torque T is T (1 - c) / (8 pi viscosity a^3), c the volume fraction, to order
/// c^(10/3).
double turning(KernelKind kernel, double radius, MarkerKind kind)
{
  const int n = static_cast<int>(4 * radius);
  const Grid grid{{n, n, n}, {0, 0, 0}, {1, 1, 1}, false};
  const Real3 centre{n / 2 + 0.1, n / 2 + 0.2, n / 2 + 0.3};
  Points points = sphere(centre, radius, 0.7);
  const double share = 4 * pi * radius * radius / points.count();
  for (const Real3 &x : points.position)
    points.force.push_back(
        {-3 * share * (x[1] - centre[1]) / radius, 3 * share * (x[0] - centre[0]) / radius, 0});
  const Decomposition decomposition = even(grid, {1, 1, ranks()});
  const auto velocity = velocities(grid, decomposition, kernel, points, kind);
  assign(points, grid, decomposition);
  double along = 0, moment = 0;
  for (int m : points.index) {
    const double x = points.position[m][0] - centre[0], y = points.position[m][1] - centre[1];
    along += x * velocity[m][1] - y * velocity[m][0];
    moment += x * x + y * y;
  }
  reduce(MPI_SUM, along, moment);
  const double fraction = 4 * pi / 3 / 64;
  return along / moment / (1 - fraction);
}

TEST(Sheet, TurningSphere)
{
  for (KernelKind kernel : kernels) {
    const double lag = 3 * surface_offset(kernel);
    double before = 0;
    for (double radius : {4.0, 8.0, 16.0}) {
      const double as_points = turning(kernel, radius, MarkerKind::points) - 1;
      const double as_sheet = turning(kernel, radius, MarkerKind::sheets) - 1;
      EXPECT_NEAR(as_points * radius / lag, -1, 0.2);
      EXPECT_LT(std::abs(as_sheet) * radius * radius, 0.3);
      if (before != 0) {
        EXPECT_LT(std::abs(as_sheet), 0.3 * std::abs(before));
      }
      before = as_sheet;
    }
  }
}

TEST(Sheet, IsTheSameOnAnyRanks)
{
  for (bool walls : {false, true})
    for (KernelKind kernel : kernels) {
      const Grid grid{{16, 12, 14}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, walls};
      const Points points = scatter(grid, 60, 2);
      const auto expected = velocities(grid, alone(grid), kernel, points, MarkerKind::sheets);
      for (const auto &[name, decomposition] : layouts(grid)) {
        SCOPED_TRACE(name);
        const auto found = velocities(grid, decomposition, kernel, points, MarkerKind::sheets);
        for (int n = 0; n < points.count(); ++n)
          for (int d = 0; d < 3; ++d) {
            if (std::isnan(found[n][d])) continue;
            EXPECT_NEAR(found[n][d], expected[n][d], 1e-12);
          }
      }
    }
}

/// Away from plates forces on sheets never gain energy, and one moves another as the other moves
/// it.
TEST(Sheet, MobilityIsSymmetricAndPositive)
{
  const Grid grid{{16, 12, 14}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, false};
  Points one = scatter(grid, 60, 3), other = one;
  for (int n = 0; n < one.count(); ++n) other.force[n] = {noise(8, n), noise(9, n), noise(10, n)};
  const auto work = [&](const Points &on, const Points &by) {
    const auto v = velocities(grid, alone(grid), KernelKind::roma3, by, MarkerKind::sheets);
    double sum = 0;
    for (int n = 0; n < on.count(); ++n)
      for (int d = 0; d < 3; ++d) sum += on.force[n][d] * v[n][d];
    return sum;
  };
  EXPECT_GT(work(one, one), 0);
  EXPECT_NEAR(work(one, other), work(other, one), 1e-12 * work(one, one));
}

}    // namespace
