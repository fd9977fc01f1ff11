// Even forces along the normals of closed surfaces move no fluid, but markers see a flow.

#include "fluid/mobility_preconditioner.h"
#include "fluid/normal_alias.h"
#include "rigid_sphere.h"
#include "test_support.h"

namespace {

using namespace test;

constexpr KernelKind kernels[] = {KernelKind::peskin4, KernelKind::roma3};
constexpr MarkerKind kinds[] = {MarkerKind::points, MarkerKind::sheets};

/// Mean velocity of markers along their normals in a fluid of some viscosity, each of which bears
/// the force of a pressure of 1 on an area; with what they yield to it, if asked for.
double mean_along(const Grid &grid, KernelKind kernel, MarkerKind kind, Points points,
                  const std::vector<Real3> &normals, double area, bool yielding)
{
  FlowEquations equations;
  equations.viscosity = 0.7;
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 6, equations);
  assign(points, grid, flow.decomposition());
  points.force = normals;
  for (Real3 &force : points.force)
    for (double &component : force) component *= area;
  std::vector<Real3> velocity(points.count(), {0, 0, 0});
  flow.apply_mobility(points.markers(kernel, kind), points.f(), numbers(velocity));
  if (yielding) {
    Points mine;
    for (int n : points.index) {
      mine.position.push_back(points.position[n]);
      mine.force.push_back(points.force[n]);
    }
    for (int n = 0; n < mine.count(); ++n) mine.index.push_back(n);
    const std::vector<int> body(mine.count(), 0);
    std::vector<Real3> more(mine.count());
    MobilityPreconditioner preconditioner;
    preconditioner.build(flow, mine.markers(kernel, kind), body.data());
    preconditioner.apply_compliance(mine.f(), numbers(more));
    for (int n = 0; n < mine.count(); ++n)
      for (int d = 0; d < 3; ++d) velocity[points.index[n]][d] += more[n][d];
  }
  double along = 0;
  for (int n : points.index)
    for (int d = 0; d < 3; ++d) along += velocity[n][d] * normals[n][d];
  return test::sum(along) / points.count() * equations.viscosity / grid.spacing[0];
}

/// A plane through all of a periodic box, across a direction of whole numbers, of markers much
/// closer than a cell.
struct Plane {
  static constexpr int n = 20;
  static constexpr double h = 0.8;
  Grid grid{{n, n, n}, {0, 0, 0}, {h, h, h}, false};
  Points points;
  Real3 normal;
  double area;

  Plane(const Index3 &across, double place)
  {
    constexpr int side = 3 * n + 1;
    const double length = std::hypot(across[0], across[1], across[2]);
    for (int d = 0; d < 3; ++d) normal[d] = across[d] / length;
    area = length / across[2] * (n * h) * (n * h) / (side * side);
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j)
        for (int turn = 0; turn < across[2]; ++turn) {
          const double x = n * (i + 0.3) / side, y = n * (j + 0.6) / side;
          double z = (place - across[0] * x - across[1] * y + n * turn) / across[2];
          z -= n * std::floor(z / n);
          points.position.push_back({h * x, h * y, h * z});
        }
  }
};

TEST(NormalAlias, OfPlanes)
{
  constexpr int places = 4;
  for (const Index3 &across : {Index3{0, 0, 1}, {0, 1, 1}, {0, 1, 2}, {1, 1, 2}, {1, 2, 3}})
    for (KernelKind kernel : kernels)
      for (MarkerKind kind : kinds) {
        double mean = 0, expected = 0;
        for (int place = 0; place < places; ++place) {
          const Plane plane(across, (place + 0.37) / places);
          const std::vector<Real3> normals(plane.points.count(), plane.normal);
          expected = normal_alias(kernel, kind, plane.normal);
          mean += mean_along(plane.grid, kernel, kind, plane.points, normals, plane.area, false) /
                  places;
        }
        const double largest = normal_alias(kernel, kind, {0, std::sqrt(0.2), std::sqrt(0.8)});
        EXPECT_NEAR(mean, expected, 0.15 * largest) << across[0] << across[1] << across[2];
      }
}

TEST(NormalAlias, IsTakenOffASphere)
{
  const Grid grid{{30, 30, 30}, {0, 0, 0}, {1, 1, 1}, false};
  const Real3 centre{15.1, 15.2, 15.3};
  constexpr double radius = 10.3;
  for (KernelKind kernel : kernels)
    for (MarkerKind kind : kinds) {
      const Points points = sphere(centre, radius, 1.1);
      std::vector<Real3> normals(points.count());
      for (int n = 0; n < points.count(); ++n)
        for (int d = 0; d < 3; ++d) normals[n][d] = (points.position[n][d] - centre[d]) / radius;
      const double area = 4 * pi * radius * radius / points.count();
      const double before = mean_along(grid, kernel, kind, points, normals, area, false);
      const double after = mean_along(grid, kernel, kind, points, normals, area, true);
      EXPECT_GT(after, 0);
      double expected = 0;
      for (const Real3 &normal : normals)
        expected += normal_alias(kernel, kind, normal) / points.count();
      EXPECT_LT(after, before - 0.5 * expected);    // what passes between markers is left
    }
}

/// By Cholesky's factors, in place.
bool is_positive_definite(std::vector<double> &matrix, int n)
{
  for (int j = 0; j < n; ++j) {
    double *const row = &matrix[std::size_t(j) * n];
    for (int k = 0; k < j; ++k) row[j] -= row[k] * row[k];
    if (!(row[j] > 0)) return false;
    row[j] = std::sqrt(row[j]);
    for (int i = j + 1; i < n; ++i) {
      double *const other = &matrix[std::size_t(i) * n];
      for (int k = 0; k < j; ++k) other[j] -= other[k] * row[k];
      other[j] /= row[j];
    }
  }
  return true;
}

/// Of markers as close as is sensible, and closer.
TEST(NormalAlias, LeavesTheMobilityPositive)
{
  const Grid grid{{16, 16, 16}, {0, 0, 0}, {1, 1, 1}, false};
  for (KernelKind kernel : kernels)
    for (double apart : {0.8, 0.93, 1.1}) {
      Points points = sphere({8.13, 8.27, 8.41}, 3.7, apart);
      ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 6, FlowEquations{});
      assign(points, grid, flow.decomposition());
      Points mine;
      for (int n : points.index) mine.position.push_back(points.position[n]);
      mine.force.assign(mine.count(), {0, 0, 0});
      for (int n = 0; n < mine.count(); ++n) mine.index.push_back(n);
      const std::vector<int> body(mine.count(), 0);
      MobilityPreconditioner preconditioner;
      preconditioner.build(flow, mine.markers(kernel, MarkerKind::sheets), body.data());

      const int numbers_of_all = 3 * points.count();
      std::vector<double> mobility(std::size_t(numbers_of_all) * numbers_of_all);
      for (int column = 0; column < numbers_of_all; ++column) {
        std::vector<Real3> velocity(mine.count()), more(mine.count());
        for (int n = 0; n < mine.count(); ++n) {
          mine.force[n] = {0, 0, 0};
          if (points.index[n] == column / 3) mine.force[n][column % 3] = 1;
        }
        flow.apply_mobility(mine.markers(kernel, MarkerKind::sheets), mine.f(), numbers(velocity));
        preconditioner.apply_compliance(mine.f(), numbers(more));
        double *const row = &mobility[std::size_t(column) * numbers_of_all];
        for (int n = 0; n < mine.count(); ++n)
          for (int d = 0; d < 3; ++d) row[3 * points.index[n] + d] = velocity[n][d] + more[n][d];
      }
      MPI_Allreduce(MPI_IN_PLACE, mobility.data(), static_cast<int>(mobility.size()), MPI_DOUBLE,
                    MPI_SUM, MPI_COMM_WORLD);
      EXPECT_TRUE(is_positive_definite(mobility, numbers_of_all)) << apart;
    }
}

}    // namespace
