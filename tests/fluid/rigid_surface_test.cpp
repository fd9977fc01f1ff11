#include "fluid/diagnostics.h"
#include "fluid/kernel.h"
#include "rigid_sphere.h"
#include "rigid_tube.h"

namespace {

using namespace test;

constexpr int ghost_layers = 4;
constexpr double tight = 1e-8;

/// A flow of unit viscosity with markers of rigid bodies.
struct Scene {
  ForcedFlow flow;
  std::vector<Points> bodies;
  std::vector<double> position;
  RigidSurface surface;
  std::vector<int> body;
  KernelKind kernel;

  Scene(const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
        std::vector<Points> bodies, bool free_mean, double tolerance = tight) :
      flow(grid, decomposition, ghost_layers, FlowEquations{}),
      bodies(std::move(bodies)), kernel(kernel)
  {
    RigidSurface::Settings settings;
    settings.free_mean = free_mean;
    settings.tolerance = tolerance;
    settings.max_solves = 300;
    if (tolerance < 1e-6) settings.most_directions = 300;
    surface.choose(settings);
    for (std::size_t b = 0; b < this->bodies.size(); ++b) {
      assign(this->bodies[b], grid, decomposition);
      const auto rows = rows_here(this->bodies[b].position, this->bodies[b]);
      position.insert(position.end(), rows.begin(), rows.end());
      body.insert(body.end(), this->bodies[b].index.size(), static_cast<int>(b));
    }
    surface.set_markers(flow, kernel, static_cast<int>(body.size()), position.data(), body.data());
  }

  /// body_force(c, x) is the force density; velocity(b) is that of a body.
  template <typename Force, typename Velocity>
  RigidSurface::Outcome solve(Force body_force, Velocity velocity, double time = 0)
  {
    const Grid &grid = flow.grid();
    flow.clear_force();
    Real3 total{0, 0, 0};
    for (int c = 0; c < 3; ++c)
      set(flow.force()[c], flow.brick(), [&](int i, int j, int k) {
        const double f = body_force(c, location(grid, c, i, j, k));
        total[c] += f * grid.cell_volume();
        return f;
      });
    for (std::size_t n = 0; n < body.size(); ++n) {
      const Real3 u = velocity(body[n]);
      std::copy_n(u.data(), 3, surface.target() + 3 * n);
    }
    EXPECT_LT(surface.spread(flow, time, total), 0);
    flow.accumulate_ghosts();
    if (surface.settings().free_mean) flow.forcing.mean = surface.mean();
    flow.solve();
    const auto outcome = surface.enforce(flow);
    if (surface.settings().free_mean) flow.forcing.mean = surface.mean();
    EXPECT_TRUE(outcome.converged) << outcome.slip;
    return outcome;
  }

  /// On the fluid, by one body.
  Real3 force(int of)
  {
    Real3 sum{0, 0, 0};
    for (std::size_t n = 0; n < body.size(); ++n)
      for (int d = 0; d < 3; ++d)
        if (body[n] == of) sum[d] += surface.force()[3 * n + d];
    reduce(MPI_SUM, sum[0], sum[1], sum[2]);
    return sum;
  }
};

constexpr auto no_force = [](int, const Real3 &) { return 0.0; };
constexpr auto at_rest = [](int) { return Real3{0, 0, 0}; };

/// Half the mean distance of two points spread by the kernel of a marker at s.
template <typename Kernel> double offset(double s)
{
  double w[4], sum = 0;
  Kernel::weights(s, w);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) sum += 0.5 * w[a] * w[b] * std::abs(a - b);
  return sum;
}

template <typename Kernel> double mean_offset()
{
  constexpr int places = 1000;
  double sum = 0;
  for (int n = 0; n < places; ++n) sum += offset<Kernel>((n + 0.5) / places) / places;
  return sum;
}

TEST(RigidSurface, OffsetIsThatOfTheKernel)
{
  EXPECT_NEAR(mean_offset<Peskin4>(), surface_offset(KernelKind::peskin4), 1e-4);
  EXPECT_NEAR(mean_offset<Roma3>(), surface_offset(KernelKind::roma3), 1e-4);
}

/// A plane of markers that moves along itself between two plates: Couette flow on both sides. With
/// a marker to a cell the problem is that of one dimension, where the offset is exact.
TEST(RigidSurface, MovingPlane)
{
  const Grid grid{{16, 16, 24}, {0, 0, 0}, {1, 1, 1}, true};
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (double z : {12.0, 12.3, 7.7}) {
      Points plane;
      for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 16; ++j) plane.position.push_back({i + 0.1, j + 0.7, z});
      Scene scene(grid, even(grid, {1, ranks(), 1}), kernel, {plane}, false);
      const Real3 velocity{1, 0.5, 0};
      scene.solve(no_force, [&](int) { return velocity; });
      const double both = 1 / z + 1 / (24 - z), s = z - 0.5;
      const double into_fluid =
          kernel == KernelKind::peskin4 ? offset<Peskin4>(s) : offset<Roma3>(s);
      const double per_speed = 1 / (1 / both - into_fluid);
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(scene.force(0)[d] / (16 * 16), velocity[d] * per_speed, 5e-4 * per_speed);
    }
}

/// A plane that moves across a periodic box takes all fluid with it, with no force; the mean
/// velocity follows.
TEST(RigidSurface, CarriesItsFluid)
{
  const Grid grid{{16, 16, 16}, {0, 0, 0}, {1, 1, 1}, false};
  const Points body = tube(grid, 5, 1.2);
  Scene scene(grid, even(grid, {1, ranks(), 1}), KernelKind::peskin4, {body}, true);
  const auto outcome = scene.solve(no_force, [](int) { return Real3{0.3, 0, -0.2}; });
  EXPECT_LT(outcome.slip, 1e-12);
  EXPECT_EQ(outcome.solves, 1);
  for_each(scene.flow.brick(), [&](int i, int j, int k) {
    EXPECT_NEAR(scene.flow.velocity()[0](i, j, k), 0.3, 1e-12);
    EXPECT_NEAR(scene.flow.velocity()[2](i, j, k), -0.2, 1e-12);
  });
}

/// Rate of flow along x through the tube, in each plane of faces; radius(x) bounds it.
template <typename Radius> std::vector<double> flow_rates(const Scene &scene, Radius radius)
{
  const Grid &grid = scene.flow.grid();
  std::vector<double> rates(grid.cells[0], 0.0);
  for_each(scene.flow.brick(), [&](int i, int j, int k) {
    const Real3 x = location(grid, 0, i, j, k);
    if (from_axis(grid, x) < radius(x[0]))
      rates[i] += scene.flow.velocity()[0](i, j, k) * grid.spacing[1] * grid.spacing[2];
  });
  MPI_Allreduce(MPI_IN_PLACE, rates.data(), grid.cells[0], MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return rates;
}

std::vector<double> flow_rates(const Scene &scene, double radius)
{
  return flow_rates(scene, [radius](double) { return radius; });
}

Grid around_tube(double radius, double length)
{
  const int wide = fast_size(static_cast<int>(std::ceil(2 * radius + 8)));
  return {
      {fast_size(static_cast<int>(std::lround(length))), wide, wide}, {0, 0, 0}, {1, 1, 1}, false};
}

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

TEST(RigidSurface, Leakage)
{
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3}) {
    EXPECT_LT(leakage(kernel, 14, 0), 1e-3);
    const double coarse = leakage(kernel, 14, 7), fine = leakage(kernel, 28, 14);
    std::printf("throat: %.4f of the flow crosses its wall, %.4f on a grid twice as fine\n", coarse,
                fine);
    EXPECT_GT(order(coarse, fine), 0.9);
  }
}

struct PoiseuilleError {
  double rate, leakage;    ///< relative to the closed form; through the wall, to the rate
};

/// A force density within a tube drives the flow.
PoiseuilleError poiseuille(KernelKind kernel, double radius)
{
  const Grid grid = around_tube(radius, 2 * radius);
  const double markers = radius + surface_offset(kernel);
  Scene scene(grid, even(grid, {1, 1, ranks()}), kernel, {tube(grid, markers, 1.2)}, true, 1e-4);
  scene.solve(
      [&](int c, const Real3 &x) { return c == 0 && from_axis(grid, x) < radius ? 1.0 : 0.0; },
      at_rest);
  const auto rates = flow_rates(scene, markers);
  const auto [least, most] = std::minmax_element(rates.begin(), rates.end());
  return {*most / (pi * std::pow(radius, 4) / 8) - 1, (*most - *least) / *most};
}

/// Radii in cells; 14.0625 is that of a tube of 22.5 um at 0.8 um.
TEST(RigidSurface, PoiseuilleFlow)
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

/// Drag over 6 pi viscosity a U of a simple cubic array of n^3 cells a sphere, U the mean velocity.
double array(KernelKind kernel, double radius, double markers, int n)
{
  const Grid grid{{n, n, n}, {0, 0, 0}, {1, 1, 1}, false};
  Scene scene(grid, even(grid, {1, 1, ranks()}), kernel,
              {sphere({n / 2 + 0.1, n / 2 + 0.2, n / 2 + 0.3}, markers, 1.2)}, false, 1e-4);
  scene.flow.forcing.mean = {1, 0, 0};
  scene.solve(no_force, at_rest);
  return -scene.force(0)[0] / (6 * pi * radius);
}

/// Radius of the markers of a sphere that has, in a dilute array, the drag of the radius wanted.
double dilute_radius(KernelKind kernel, double wanted)
{
  const int n = fast_size(static_cast<int>(std::ceil(8 * wanted)));
  double markers = wanted - surface_offset(kernel);
  for (int round = 0; round < 2; ++round) {
    const double drag = array(kernel, 1, markers, n);
    double a = markers;
    for (int iteration = 0; iteration < 50; ++iteration) a = drag / dilute_array(a / n);
    markers += wanted - a;
  }
  return markers;
}

/// Zick & Homsy, J. Fluid Mech. 115 (1982) 13, Table 2: up to a volume fraction of 0.343.
TEST(RigidSurface, SimpleCubicArray)
{
  const double table[][2]{{0.18610515, 2.008},
                          {0.2481402, 2.810},
                          {0.31017525, 4.292},
                          {0.37221029, 7.442},
                          {0.43424534, 15.4}};
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (const auto &[share, reference] : table) {
      const double calibrated = array(kernel, share * 24, dilute_radius(kernel, share * 24), 24);
      EXPECT_NEAR(calibrated, reference, 0.02 * reference) << share;
    }
}

/// With the offset of a plane instead of the radius measured in a dilute array.
TEST(RigidSurface, OffsetOfAPlaneIsOfSecondOrder)
{
  constexpr double share = 0.31017525, reference = 4.292;
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3}) {
    double error[2];
    for (int n : {24, 48}) {
      const double radius = share * n;
      error[n / 48] = array(kernel, radius, radius - surface_offset(kernel), n) / reference - 1;
    }
    EXPECT_LT(std::abs(error[1]), 0.02);
    EXPECT_GT(order(error[0], error[1]), 1.6);
  }
}

/// Drag 6 pi viscosity a (K1 U - K2 V) of a sphere on the axis of a tube, V the velocity on the
/// axis far away, by the method of reflections with all images (multipoles and Fourier-Bessel
/// integrals, to more digits than given).
TEST(RigidSurface, SphereOnTheAxisOfATube)
{
  const double table[][3]{{0.1, 1.263216, 1.254796},
                          {0.3, 2.370075, 2.228958},
                          {0.5, 5.947265, 4.995246},
                          {0.7, 24.67595, 17.47401}};
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (const auto &[share, k1, k2] : table) {
      if (kernel == KernelKind::roma3 && share < 0.6) continue;
      const bool small = share < 0.2;
      const double radius = small ? 32 : 16, a = share * radius;
      const double markers = radius + surface_offset(kernel);
      const Grid grid = around_tube(radius, (small ? 3 : 5) * radius);
      const double middle = 0.5 * grid.cells[1];
      Scene scene(grid, even(grid, {1, 1, ranks()}), kernel,
                  {tube(grid, markers, 1.2), sphere({0.5 * grid.cells[0] + 0.1, middle, middle},
                                                    dilute_radius(kernel, a), 1.2)},
                  true, 1e-4);
      // the tube is driven past the sphere at rest; then the sphere moves
      double force[2], speed[2];
      for (int moves : {0, 1}) {
        scene.solve(
            [&](int c, const Real3 &x) {
              return !moves && c == 0 && from_axis(grid, x) < radius ? 1e-3 : 0.0;
            },
            [&](int body) {
              return Real3{double(moves && body == 1), 0, 0};
            },
            moves);
        force[moves] = scene.force(1)[0] / (6 * pi * a);
        speed[moves] = 2 * flow_rates(scene, markers)[0] / (pi * radius * radius);
      }
      const double found2 = -force[0] / speed[0], found1 = force[1] + found2 * speed[1];
      EXPECT_NEAR(found2 / found1, k2 / k1, 0.005 * k2 / k1) << share;
      EXPECT_NEAR(found1, k1, 0.06 * k1) << share;
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

TEST(RigidSurface, SolvesOfAnEvaluation)
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

/// A force as of a vertex pressed against the wall: markers yield by more than is allowed, and the
/// rest is solved for.
TEST(RigidSurface, ForceNextToTheWall)
{
  constexpr double radius = 14;
  const Grid grid = around_tube(radius, 2 * radius);
  const Real3 x0{5, 0.5 * grid.cells[1] + radius - 0.3, 0.5 * grid.cells[2]};
  const auto force = [&](int c, const Real3 &x) {
    const double square =
        std::pow(x[0] - x0[0], 2) + std::pow(x[1] - x0[1], 2) + std::pow(x[2] - x0[2], 2);
    return (c == 0 && from_axis(grid, x) < radius ? 1.0 : 0.0) +
           (c == 1 ? 1000 : 0) * std::exp(-square);
  };
  double mean[2], largest = 0;
  int solves[2];
  for (bool exact : {false, true}) {
    Scene scene(grid, even(grid, {1, 1, ranks()}), KernelKind::peskin4,
                {tube(grid, radius + surface_offset(KernelKind::peskin4), 1.2)}, true,
                exact ? 1e-6 : 1e-3);
    const auto outcome = scene.solve(force, at_rest);
    std::printf("slip %.2g after %d solves\n", outcome.slip, outcome.solves);
    EXPECT_TRUE(outcome.converged);
    EXPECT_GT(outcome.slip, 1e-3);
    solves[exact] = outcome.solves;
    mean[exact] = scene.flow.forcing.mean[0];
    largest = scene.flow.diagnose().max_speed;
  }
  std::printf("mean velocity %.6g, %.6g, largest %.6g\n", mean[0], mean[1], largest);
  EXPECT_NEAR(mean[0], mean[1], 1e-3 * largest);
  EXPECT_LT(2 * solves[0], solves[1]);
}

/// The same forces and flow on one rank and on all.
TEST(RigidSurface, DoesNotDependOnTheDecomposition)
{
  const Grid grid = around_tube(6, 12);
  const auto results = [&](const Decomposition &decomposition) {
    Scene scene(grid, decomposition, KernelKind::peskin4,
                {tube(grid, 6, 1.2), sphere({6.1, 9.8, 10.3}, 2, 1.2)}, true, 1e-9);
    const auto outcome =
        scene.solve([](int c, const Real3 &x) { return c == 0 ? 1 + 0.5 * std::sin(x[1]) : 0.0; },
                    [](int body) {
                      return body == 1 ? Real3{2, 0.5, 0} : Real3{0, 0, 0};
                    });
    EXPECT_LT(outcome.slip, 0.01);
    double sums[6] = {0, 0, 0, 0, 0, 0};
    for (std::size_t n = 0; n < scene.body.size(); ++n)
      for (int d = 0; d < 3; ++d) sums[3 * scene.body[n] + d] += scene.surface.force()[3 * n + d];
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, decomposition.comm);
    const Real3 mean = scene.flow.forcing.mean;
    return std::array<double, 7>{sums[0], sums[1], sums[2], sums[3], sums[4], mean[0], mean[1]};
  };
  const auto one = results(alone(grid)), all = results(even(grid, {1, 1, ranks()}));
  for (std::size_t n = 0; n < one.size(); ++n) EXPECT_NEAR(all[n], one[n], 1e-6 * std::abs(one[0]));
}

}    // namespace
