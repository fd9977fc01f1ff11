// Sheets of markers: they move with the fluid beside them.

#include "fluid/flow.h"
#include "fluid/kernel.h"
#include "rigid_sphere.h"
#include "test_support.h"

namespace {

using namespace test;

constexpr int width = 6;
constexpr KernelKind kernels[] = {KernelKind::peskin4, KernelKind::roma3};

/// Velocities of this rank's markers in a flow of unit viscosity that their forces drive.
std::vector<Real3> velocities(const Grid &grid, const Decomposition &decomposition,
                              KernelKind kernel, Points points, MarkerKind kind)
{
  const bool shares_memory = kind == MarkerKind::sheets;    // the other flow has its own
  ForcedFlow flow(grid, decomposition, width, FlowEquations{}, shares_memory);
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

/// A sphere in the middle of a cubic box of four radii, off the symmetries of the grid.
struct SphereInBox {
  Grid grid;
  Real3 centre;
  double radius;
  Points points;

  explicit SphereInBox(double radius) :
      grid{{n(radius), n(radius), n(radius)}, {0, 0, 0}, {1, 1, 1}, false},
      centre{n(radius) / 2 + 0.1, n(radius) / 2 + 0.2, n(radius) / 2 + 0.3}, radius(radius),
      points(sphere(centre, radius, 0.7))
  {
  }
  static int n(double radius) { return static_cast<int>(4 * radius); }

  double share() const { return 4 * pi * radius * radius / points.count(); }

  /// Of a point from the centre, over the radius.
  Real3 normal(int m) const
  {
    Real3 normal;
    for (int d = 0; d < 3; ++d) normal[d] = (points.position[m][d] - centre[d]) / radius;
    return normal;
  }

  std::vector<Real3> velocity(KernelKind kernel, MarkerKind kind) const
  {
    return velocities(grid, even(grid, {1, 1, ranks()}), kernel, points, kind);
  }
};

/// Angular velocity, over the exact one, of a sphere of tractions that turn it, in a cubic array:
/// that of a torque T is T (1 - c) / (8 pi viscosity a^3), c the volume fraction, to order
/// c^(10/3).
double turning(KernelKind kernel, double radius, MarkerKind kind)
{
  SphereInBox ball(radius);
  for (int m = 0; m < ball.points.count(); ++m) {
    const Real3 n = ball.normal(m);
    ball.points.force.push_back({-3 * ball.share() * n[1], 3 * ball.share() * n[0], 0});
  }
  const auto velocity = ball.velocity(kernel, kind);
  assign(ball.points, ball.grid, even(ball.grid, {1, 1, ranks()}));
  double along = 0, moment = 0;
  for (int m : ball.points.index) {
    const Real3 n = ball.normal(m);
    along += n[0] * velocity[m][1] - n[1] * velocity[m][0];
    moment += n[0] * n[0] + n[1] * n[1];
  }
  reduce(MPI_SUM, along, moment);
  const double fraction = 4 * pi / 3 / 64;
  return along / moment / radius / (1 - fraction);
}

/// Points lag by three offsets over the radius. What is left for sheets is of third order.
TEST(Sheet, TurningSphere)
{
  for (KernelKind kernel : kernels)
    for (double radius : {4.0, 8.0, 16.0}) {
      const double as_points = turning(kernel, radius, MarkerKind::points) - 1;
      const double as_sheet = turning(kernel, radius, MarkerKind::sheets) - 1;
      std::printf("turning sphere, kernel %d, radius %g: %.5f, points %.5f\n",
                  static_cast<int>(kernel), radius, as_sheet, as_points);
      EXPECT_NEAR(as_points * radius / (3 * surface_offset(kernel)), -1, 0.2);
      EXPECT_LT(std::abs(as_sheet), 0.8 / std::pow(radius, 3) + 2e-4);
    }
}

/// Velocities normal and tangential, over those of a straining flow, of a sphere of the tractions
/// that hold it rigid in the opposite flow: 5 viscosity E n.
struct Strain {
  double normal, tangential;
};

Strain straining(KernelKind kernel, double radius)
{
  SphereInBox ball(radius);
  const auto flow = [](const Real3 &n) { return Real3{n[0], n[1], -2 * n[2]}; };
  for (int m = 0; m < ball.points.count(); ++m) {
    const Real3 e = flow(ball.normal(m));
    ball.points.force.push_back(
        {5 * ball.share() * e[0], 5 * ball.share() * e[1], 5 * ball.share() * e[2]});
  }
  const auto velocity = ball.velocity(kernel, MarkerKind::sheets);
  assign(ball.points, ball.grid, even(ball.grid, {1, 1, ranks()}));
  double normal = 0, normal_flow = 0, all = 0, all_flow = 0;
  for (int m : ball.points.index) {
    const Real3 n = ball.normal(m), e = flow(n);
    double un = 0, en = 0;
    for (int d = 0; d < 3; ++d) {
      un += velocity[m][d] * n[d];
      en += e[d] * n[d];
      all += velocity[m][d] * e[d];
      all_flow += e[d] * e[d];
    }
    normal += un * en;
    normal_flow += en * en;
  }
  reduce(MPI_SUM, normal, normal_flow, all, all_flow);
  return {normal / normal_flow / radius, (all - normal) / (all_flow - normal_flow) / radius};
}

/// Without the fourth-order term, and C_2 = 0.56 in its place, normal velocities with roma3 are
/// 10 % too large and tangential ones 9 % too small at a radius of 4 cells. The limit, which images
/// in the array change, is extrapolated.
TEST(Sheet, StrainingSphere)
{
  for (KernelKind kernel : kernels) {
    const Strain coarse = straining(kernel, 8), fine = straining(kernel, 16);
    const double normal = fine.normal + (fine.normal - coarse.normal) / 7;
    const double tangential = fine.tangential + (fine.tangential - coarse.tangential) / 7;
    for (double radius : {4.0, 6.0, 8.0}) {
      const Strain found = straining(kernel, radius);
      std::printf("straining sphere, kernel %d, radius %g: normal %.4f, tangential %.4f\n",
                  static_cast<int>(kernel), radius, found.normal / normal - 1,
                  found.tangential / tangential - 1);
      const double scale = kernel == KernelKind::roma3 ? 1 : 1.75;    // ratio of the variances
      EXPECT_LT(std::abs(found.normal / normal - 1),
                scale * (0.85 / std::pow(radius, 2) + 2 / std::pow(radius, 3)));
      EXPECT_LT(std::abs(found.tangential / tangential - 1),
                scale * 2.5 / std::pow(radius, 3) + 1e-3);
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
