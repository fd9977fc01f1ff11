// Spreading and interpolation through the whole chain of spread, fold at the plates and add ghosts
// back, and fill ghosts, reflect at the plates and interpolate.

#include "fluid/plates.h"
#include "test_support.h"

using namespace test;

namespace {

constexpr PlateCondition no_slip = PlateCondition::no_slip, free_slip = PlateCondition::free_slip;
constexpr int width = 4;    // reach of the widest kernel, and one cell of drift

std::vector<Grid> grids()
{
  return {{{12, 9, 8}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, false},
          {{12, 9, 8}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, true},
          {{5, 4, 20}, {0, 0, 0.1}, {1. / 3, 0.7, 0.1}, true},
          {{4, 10, 4}, {-1, 7, -3}, {0.1, 0.3, 1. / 7}, true},
          {{12, 9, 8}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, true, {free_slip, no_slip}},
          {{5, 4, 20}, {0, 0, 0.1}, {1. / 3, 0.7, 0.1}, true, {no_slip, free_slip}},
          {{12, 9, 8}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, true, {free_slip, free_slip}}};
}

bool sticks(const Grid &grid, bool upper)
{
  return (upper ? grid.plate_conditions.upper : grid.plate_conditions.lower) == no_slip;
}

/// Check(grid, decomposition, kernel, markers that drifted out of their owner's brick).
template <typename Check> void for_each_case(Check check)
{
  for (const Grid &grid : grids())
    for (const auto &[name, decomposition] : layouts(grid))
      for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3}) {
        SCOPED_TRACE(describe(grid) + ", " + name +
                     (kernel == KernelKind::peskin4 ? ", Peskin4" : ", Roma3"));
        Points points = scatter(grid, 64, 11);
        assign(points, grid, decomposition);
        drift(points, grid, 12);
        check(grid, decomposition, kernel, points);
      }
}

/// Force density on the bricks, and what the plates take of it.
struct Spread {
  VectorField force;
  Real3 lower{0, 0, 0}, upper{0, 0, 0};
};

Spread spread_points(const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
                     const Points &points, double factor)
{
  Halo halo(grid, decomposition, width);
  Spread result{VectorField(halo.box())};
  EXPECT_EQ(spread(grid, points.markers(kernel), points.f(), factor, result.force), -1);
  if (grid.plates) fold_force(grid, result.force, result.lower, result.upper);
  halo.accumulate(result.force.views());
  return result;
}

/// Velocity at this rank's markers; the others' stay undefined.
std::vector<Real3> interpolate_points(const Grid &grid, const Decomposition &decomposition,
                                      KernelKind kernel, const Points &points,
                                      const PlateVelocities &walls, const VectorField &velocity)
{
  Halo halo(grid, decomposition, width);
  halo.fill(velocity.views());
  if (grid.plates) reflect_velocity(grid, walls, velocity);
  std::vector<Real3> result(points.count(), {undefined, undefined, undefined});
  interpolate(grid, points.markers(kernel), velocity, numbers(result));
  return result;
}

VectorField stored_field(const Grid &grid, const Decomposition &decomposition)
{
  return VectorField(Halo(grid, decomposition, width).box());
}

/// Where the equations have no unknown: faces on the lower plate.
bool on_plate(const Grid &grid, int c, int k)
{
  return grid.plates && c == 2 && k == 0;
}

TEST(Coupling, SpreadingIsTheTransposeOfInterpolation)
{
  for_each_case([](const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
                   const Points &points) {
    const Box &brick = decomposition.mine();
    VectorField velocity = noise_field(stored_field(grid, decomposition).box(), brick, 5);
    for_each(brick, [&](int i, int j, int k) {
      if (on_plate(grid, 2, k)) velocity[2](i, j, k) = 0;
    });
    const Spread spread = spread_points(grid, decomposition, kernel, points, 1);
    double on_grid = dot(spread.force, velocity, brick) * grid.cell_volume();

    const auto at_markers = interpolate_points(grid, decomposition, kernel, points, {}, velocity);
    double on_markers = 0, size = 0;
    for (int n : points.index)
      for (int d = 0; d < 3; ++d) {
        on_markers += points.force[n][d] * at_markers[n][d];
        size += std::abs(points.force[n][d] * at_markers[n][d]);
      }
    reduce(MPI_SUM, on_grid, on_markers, size);
    EXPECT_NEAR(on_grid, on_markers, 1e-13 * size);
  });
}

TEST(Coupling, GridAndPlatesReceiveTheWholeForce)
{
  for_each_case([](const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
                   const Points &points) {
    const double factor = 2.5;
    const Spread spread = spread_points(grid, decomposition, kernel, points, factor);
    for (int c = 0; c < 3; ++c) {
      double received = spread.lower[c] + spread.upper[c], applied = 0, size = 0;
      for_each(decomposition.mine(), [&](int i, int j, int k) {
        if (!on_plate(grid, c, k)) received += spread.force[c](i, j, k);
      });
      for (int n = 0; n < points.count(); ++n) {
        applied += factor * points.force[n][c];
        size += factor * std::abs(points.force[n][c]);
      }
      EXPECT_NEAR(sum(received) * grid.cell_volume(), applied, 1e-13 * size) << "component " << c;
    }
  });
}

/// For ghosts and bricks of any width: what lies on or beyond a plate comes back on every rank.
TEST(Coupling, FoldingIsTheTransposeOfReflection)
{
  for (const Grid &grid : grids())
    for (const auto &[name, decomposition] : layouts(grid))
      for (int layers = 1; layers <= 5; ++layers) {
        if (!grid.plates) continue;
        SCOPED_TRACE(describe(grid) + ", " + name + ", ghost layers " + std::to_string(layers));
        const Box &brick = decomposition.mine();
        Halo halo(grid, decomposition, layers);
        VectorField velocity = noise_field(halo.box(), brick, 6),
                    folded = noise_field(halo.box(), halo.box(), 7 + rank());
        VectorField reflected = noise_field(halo.box(), brick, 6),
                    force = noise_field(halo.box(), halo.box(), 7 + rank());
        halo.fill(reflected.views());
        reflect_velocity(grid, {}, reflected);
        Real3 lower{0, 0, 0}, upper{0, 0, 0};
        fold_force(grid, folded, lower, upper);
        halo.accumulate(folded.views());

        double left = 0, right = 0, size = 0;
        Real3 spread{0, 0, 0}, kept{lower[0] + upper[0], lower[1] + upper[1], lower[2] + upper[2]};
        for (int c = 0; c < 3; ++c) {
          for_each(halo.box(), [&](int i, int j, int k) {
            left += reflected[c](i, j, k) * force[c](i, j, k);
            size += std::abs(reflected[c](i, j, k) * force[c](i, j, k));
            spread[c] += force[c](i, j, k);
          });
          for_each(brick, [&](int i, int j, int k) {
            if (on_plate(grid, c, k)) return;
            right += velocity[c](i, j, k) * folded[c](i, j, k);
            kept[c] += folded[c](i, j, k);
          });
        }
        reduce(MPI_SUM, left, right, size);
        reduce(MPI_SUM, spread[0], spread[1], spread[2], kept[0], kept[1], kept[2]);
        EXPECT_NEAR(left, right, 1e-13 * size);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(spread[c], kept[c], 1e-13 * size) << "component " << c;
      }
}

TEST(Coupling, InterpolatesAUniformFlowExactly)
{
  const Real3 u{0.3, -0.7, 0.2};
  for_each_case([&](const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
                    const Points &points) {
    const Real3 uniform{u[0], u[1], grid.plates ? 0 : u[2]};
    const VectorField velocity = stored_field(grid, decomposition);
    set_vector(velocity, grid, decomposition.mine(),
               [&](int c, const Real3 &) { return uniform[c]; });
    const auto result =
        interpolate_points(grid, decomposition, kernel, points, {uniform, uniform}, velocity);
    Error error;
    for (int n : points.index)
      for (int d = 0; d < 3; ++d) error.add(result[n][d] - uniform[d]);
    EXPECT_LT(error.over_ranks().largest, 1e-14);
  });
}

TEST(Coupling, InterpolatesAShearFlowExactlyUpToThePlates)
{
  const PlateVelocities walls{{0.3, -0.7, 0}, {-1.1, 0.4, 0}};
  for_each_case([&](const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
                    const Points &points) {
    if (!grid.plates || !sticks(grid, false) || !sticks(grid, true)) return;
    const auto shear = [&](int c, double z) {
      const double zeta = (z - grid.origin[2]) / (grid.spacing[2] * grid.cells[2]);
      return walls.lower[c] + (walls.upper[c] - walls.lower[c]) * zeta;
    };
    const VectorField velocity = stored_field(grid, decomposition);
    set_vector(velocity, grid, decomposition.mine(),
               [&](int c, const Real3 &x) { return shear(c, x[2]); });
    const auto result = interpolate_points(grid, decomposition, kernel, points, walls, velocity);
    Error error;
    for (int n : points.index)
      for (int d = 0; d < 3; ++d) error.add(result[n][d] - shear(d, points.position[n][2]));
    EXPECT_LT(error.over_ranks().largest, 1e-14);
  });
}

TEST(Coupling, AMarkerOnAPlateHasItsVelocity)
{
  const PlateVelocities walls{{0.3, -0.7, 0}, {-1.1, 0.4, 0}};
  for_each_case([&](const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
                    const Points &points) {
    if (!grid.plates) return;
    VectorField velocity =
        noise_field(stored_field(grid, decomposition).box(), decomposition.mine(), 3);
    const auto result = interpolate_points(grid, decomposition, kernel, points, walls, velocity);
    Error error;
    for (int n : points.index)
      for (int d = 0; d < 3; ++d) {
        if (n % 8 == 0 && (d == 2 || sticks(grid, false))) error.add(result[n][d] - walls.lower[d]);
        if (n % 8 == 1 && (d == 2 || sticks(grid, true))) error.add(result[n][d] - walls.upper[d]);
      }
    EXPECT_LT(error.over_ranks().largest, 1e-14);
  });
}

TEST(Coupling, SelectsMarkersByIndex)
{
  const Grid grid = grids()[0];
  const Decomposition decomposition = alone(grid);
  Points points = scatter(grid, 8, 1);
  points.index = {6, 1, 3};
  Points chosen;
  for (int n : points.index) {
    chosen.position.push_back(points.position[n]);
    chosen.force.push_back(points.force[n]);
  }
  chosen.index = {0, 1, 2};
  const Spread some = spread_points(grid, decomposition, KernelKind::peskin4, points, 1);
  const Spread all = spread_points(grid, decomposition, KernelKind::peskin4, chosen, 1);
  for (int c = 0; c < 3; ++c)
    for_each(grid.domain(), [&](int i, int j, int k) {
      EXPECT_EQ(some.force[c](i, j, k), all.force[c](i, j, k));
    });

  const auto result =
      interpolate_points(grid, decomposition, KernelKind::peskin4, points, {}, some.force);
  for (int n : {0, 2, 4, 5, 7})
    for (int d = 0; d < 3; ++d) EXPECT_TRUE(std::isnan(result[n][d]));
}

TEST(Coupling, ReportsTheFirstMarkerThatIsNotInReach)
{
  for (const Grid &grid : grids())
    for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
      for (double bad :
           {undefined, double(INFINITY), -double(INFINITY), 1e9, -1e9, 1e12, -1e12, 1e300, -1e300})
        for (int d = 0; d < 3; ++d) {
          SCOPED_TRACE(describe(grid) + ", direction " + std::to_string(d) + ": " +
                       std::to_string(bad));
          const VectorField force = stored_field(grid, alone(grid));
          Points points = scatter(grid, 16, 2);
          points.index = {9, 4, 7, 2, 5};
          points.position[7][d] = points.position[2][d] = bad;
          const int reported = spread(grid, points.markers(kernel), points.f(), 1, force);
          EXPECT_EQ(reported, 7);
        }
}

/// How far outside its brick, in cells, a marker may be with ghosts of width 4: until a point of
/// its kernel, face or centre, is not stored. Rows along x are read four points at a time.
TEST(Coupling, ServesMarkersAsFarAsTheGhostsReach)
{
  const Grid grid = grids()[0];
  const auto reported = [&](KernelKind kernel, int d, double s) {
    const VectorField force = stored_field(grid, alone(grid));
    Points points = scatter(grid, 1, 3);
    points.index = {0};
    points.position[0][d] = grid.origin[d] + grid.spacing[d] * s;
    return spread(grid, points.markers(kernel), points.f(), 1, force) == 0;
  };
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (int d = 0; d < 3; ++d) {
      SCOPED_TRACE(d);
      const bool roma = kernel == KernelKind::roma3;
      const double below = roma ? 3 : 2.5, above = grid.cells[d] + (roma ? d == 0 ? 1.5 : 2.5 : 2);
      EXPECT_FALSE(reported(kernel, d, -below + 0.01));
      EXPECT_TRUE(reported(kernel, d, -below - 0.01));
      EXPECT_FALSE(reported(kernel, d, above - 0.01));
      EXPECT_TRUE(reported(kernel, d, above + 0.01));
    }
}

TEST(Coupling, ReportsMarkersBeyondThePlates)
{
  const Grid grid = grids()[1];
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (bool upper : {false, true}) {
      const VectorField force = stored_field(grid, alone(grid));
      Points points = scatter(grid, 1, 3);
      points.index = {0};
      const double beyond = 1.6 * grid.spacing[2];
      points.position[0][2] = upper ? grid.origin[2] + grid.spacing[2] * grid.cells[2] + beyond
                                    : grid.origin[2] - beyond;
      EXPECT_EQ(spread(grid, points.markers(kernel), points.f(), 1, force), 0);
    }
}

}    // namespace
