// Double layers: flows in which the fluid inside of closed surfaces has another viscosity.

#include "flow_support.h"
#include "fluid/double_layer.h"
#include "motion/gmres.h"
#include "rigid_sphere.h"

namespace {

using namespace test;

constexpr int width = 7;
constexpr KernelKind kernels[] = {KernelKind::roma3, KernelKind::peskin4};

Real3 cross(const Real3 &a, const Real3 &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Real3 &a, const Real3 &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

using Mode = Real3 (*)(const Real3 &);

/// Velocities on the unit sphere.
Real3 rotation(const Real3 &n)
{
  return cross({0.3, 0.5, -0.2}, n);
}
Real3 twist(const Real3 &n)
{
  return {-n[0] * n[2], n[1] * n[2], n[0] * n[0] - n[1] * n[1]};
}

/// A sphere of markers off the symmetries of a grid of four radii, in fluid of unit viscosity.
struct Ball {
  Grid grid;
  Real3 centre;
  double radius;
  KernelKind kernel;
  Points points;
  std::vector<Real3> strength;    ///< area times normal
  std::vector<Real3> velocity;
  ForcedFlow flow;

  Ball(double radius, KernelKind kernel, int size, bool plates = false) :
      grid{{size, size, size}, {0, 0, 0}, {1, 1, 1}, plates}, centre{size / 2 + 0.1, size / 2 + 0.2,
                                                                     size / 2 + 0.3},
      radius(radius), kernel(kernel), points(sphere(centre, radius, 0.7)),
      flow(grid, even(grid, {1, 1, ranks()}), width, FlowEquations{})
  {
    const double share = 4 * pi * radius * radius / points.count();
    for (int m = 0; m < points.count(); ++m) {
      const Real3 n = normal(m);
      strength.push_back({share * n[0], share * n[1], share * n[2]});
    }
    velocity.assign(points.count(), {0, 0, 0});
    points.force = velocity;
    assign(points, grid, flow.decomposition());
  }

  MarkerSet markers() const { return points.markers(kernel, MarkerKind::layers); }
  double volume() const { return 4 * pi / 3 * radius * radius * radius; }
  double fraction() const { return volume() / grid.size(); }

  Real3 normal(int m) const
  {
    Real3 normal;
    for (int d = 0; d < 3; ++d) normal[d] = (points.position[m][d] - centre[d]) / radius;
    return normal;
  }

  /// The flow of the forces and of the layer of `velocities`, the viscosity inside being 2.
  void solve(const std::vector<Real3> &velocities)
  {
    flow.clear_force();
    EXPECT_EQ(flow.spread(markers(), points.f(), 1), -1);
    EXPECT_EQ(flow.spread(markers(), DoubleLayer{numbers(velocities), numbers(strength)}), -1);
    flow.accumulate_ghosts();
    flow.solve();
    flow.fill_ghosts();
  }

  /// Largest difference from a velocity that is given by where a point lies from the centre, of
  /// faces that lie so many cells and more from the surface.
  template <class Expected> double error(double apart, Expected expected) const
  {
    double largest = 0;
    for (int c = 0; c < 3; ++c)
      for_each(flow.brick(), [&](int i, int j, int k) {
        Real3 r = location(grid, c, i, j, k);
        for (int d = 0; d < 3; ++d) r[d] -= centre[d];
        const double distance = std::sqrt(dot(r, r)) - radius;
        if (std::abs(distance) < apart) return;
        const double u = flow.velocity()[c](i, j, k);
        largest = std::max(largest, std::abs(u - expected(c, r, distance < 0)));
      });
    return max(largest);
  }
};

/// The layer of a body that moves as a whole is this motion inside and rest outside.
TEST(DoubleLayer, RigidMotion)
{
  for (KernelKind kernel : kernels)
    for (bool plates : {false, true}) {
      Ball ball(8, kernel, 32, plates);
      const Real3 speed{1, -0.5, 0.7};
      ball.flow.forcing.mean = {ball.fraction(), -0.5 * ball.fraction(), 0.7 * ball.fraction()};
      ball.solve(std::vector<Real3>(ball.points.count(), speed));
      const auto moved = [&](int c, const Real3 &, bool inside) { return inside ? speed[c] : 0; };
      EXPECT_LT(ball.error(4, moved), 2.5e-3);

      std::vector<Real3> turning;
      for (int m = 0; m < ball.points.count(); ++m) {
        Real3 v = rotation(ball.normal(m));
        for (double &component : v) component *= ball.radius;
        turning.push_back(v);
      }
      ball.flow.forcing.mean = {0, 0, 0};
      ball.solve(turning);
      const auto turned = [&](int c, const Real3 &r, bool inside) {
        return inside ? rotation(r)[c] : 0;
      };
      EXPECT_LT(ball.error(4, turned), 1e-3 * ball.radius);
    }
}

/// What the solve gives has the divergence asked for.
TEST(DoubleLayer, Divergence)
{
  for (bool plates : {false, true}) {
    const Grid grid{{12, 10, 14}, {0, 0, 0}, {1, 0.8, 1.3}, plates};
    for (const Layout &layout : layouts(grid)) {
      const Box &brick = layout.decomposition.mine();
      Halo halo(grid, layout.decomposition, 1);
      const VectorField force = noise_field(brick, brick, 3);
      const ScalarField source(brick);
      VectorField u(halo.box());
      double total = 0;
      for_each(brick, [&](int i, int j, int k) {
        source[0](i, j, k) = noise(7, i, j, k);
        if (plates && k == 0) force[2](i, j, k) = 0;
        total += source[0](i, j, k);
      });
      const double mean = sum(total) / grid.size();
      StokesSolver solver(grid, layout.decomposition, 1.3, 0, true);
      solver.velocity(force, {}, u, &source);
      halo.fill(u.views());
      if (plates) reflect_velocity(grid, {}, u);
      Error error;
      for_each(brick, [&](int i, int j, int k) {
        const double divergence = (u[0](i + 1, j, k) - u[0](i, j, k)) / grid.spacing[0] +
                                  (u[1](i, j + 1, k) - u[1](i, j, k)) / grid.spacing[1] +
                                  (u[2](i, j, k + 1) - u[2](i, j, k)) / grid.spacing[2];
        error.add(divergence - (source[0](i, j, k) - mean));
      });
      EXPECT_LT(error.over_ranks().largest, 1e-11) << describe(grid) << ' ' << layout.name;
    }
  }
}

/// One inside, zero outside.
TEST(DoubleLayer, Inside)
{
  for (KernelKind kernel : kernels) {
    Ball ball(6, kernel, 24);
    const ScalarField inside(ball.flow.brick());
    EXPECT_EQ(
        ball.flow.find_inside(ball.markers(), numbers(ball.strength), ball.fraction(), inside), -1);
    double wrong = 0;
    for_each(ball.flow.brick(), [&](int i, int j, int k) {
      Real3 r = location(ball.grid, centre, i, j, k);
      for (int d = 0; d < 3; ++d) r[d] -= ball.centre[d];
      const double distance = std::sqrt(dot(r, r)) - ball.radius;
      if (std::abs(distance) < 3) return;
      wrong = std::max(wrong, std::abs(inside[0](i, j, k) - (distance < 0)));
    });
    EXPECT_LT(max(wrong), 4e-3);
  }
}

/// Sums over the markers of a ball, for GMRES.
struct MarkerSums : rbc::Motion {
  void velocity(const rbc::Numbers &, double, rbc::Numbers &) override {}
  void sum(double *values, int count) const override
  {
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  }
};

/// A ball of fluid `contrast` times as viscous as that around it.
struct FluidBall : Ball {
  const std::vector<int> &mine;
  double excess;
  std::vector<Real3> step, seen, none;

  FluidBall(double radius, KernelKind kernel, int size, double contrast) :
      Ball(radius, kernel, size), mine(points.index), excess(contrast - 1), step(strength),
      none(points.count(), {0, 0, 0})
  {
    for (Real3 &row : step)
      for (double &number : row) number *= excess;
    seen = layer(std::vector<Real3>(points.count(), {1, 1, 1}), none);
  }

  double share() const { return 4 * pi * radius * radius / points.count(); }

  /// What the markers see of the layer of these velocities, with forces.
  std::vector<Real3> layer(const std::vector<Real3> &moves, const std::vector<Real3> &forces)
  {
    Real3 mean{0, 0, 0};
    for (int m : mine) {
      const double flux = dot(moves[m], step[m]) / grid.size();
      for (int d = 0; d < 3; ++d) mean[d] += flux * (points.position[m][d] - centre[d]);
    }
    reduce(MPI_SUM, mean[0], mean[1], mean[2]);
    const DoubleLayer layer{numbers(moves), numbers(step)};
    std::vector<Real3> result = none;
    EXPECT_EQ(flow.apply_mobility(markers(), numbers(forces), numbers(result), &layer, mean), -1);
    return result;
  }

  /// The velocities that forces and these velocities give. Those tangential to the ball are taken
  /// to have no divergence: the kink of their flow is -1 / radius times them.
  void evaluate(const std::vector<Real3> &forces, const rbc::Numbers &v, rbc::Numbers &after)
  {
    std::vector<Real3> moves = none;
    for (std::size_t n = 0; n < mine.size(); ++n)
      for (int d = 0; d < 3; ++d) moves[mine[n]][d] = v[3 * n + d];
    const std::vector<Real3> sees = layer(moves, forces);
    const double kink = -excess * surface_offset(kernel) / radius;
    after.resize(v.size());
    for (std::size_t n = 0; n < mine.size(); ++n)
      for (int d = 0; d < 3; ++d)
        after[3 * n + d] = (sees[mine[n]][d] - kink * v[3 * n + d]) / (1 + seen[mine[n]][d]);
  }

  /// With tractions `mode` on the surface: the velocities' part along them, over the radius.
  double response(Mode mode)
  {
    std::vector<Real3> forces = none;
    for (int m : mine) {
      forces[m] = mode(normal(m));
      for (double &number : forces[m]) number *= share();
    }
    rbc::Numbers velocity(3 * mine.size(), 0.0), right;
    evaluate(forces, velocity, right);
    rbc::Gmres gmres;
    const MarkerSums sums;
    const auto apply = [&](const rbc::Numbers &p, rbc::Numbers &to) {
      evaluate(none, p, to);
      for (std::size_t i = 0; i < p.size(); ++i) to[i] = p[i] - to[i];
    };
    gmres.solve(apply, sums, right, 1e-5 * std::sqrt(rbc::dot(sums, right, right)), velocity);
    EXPECT_LT(gmres.iterations(), 20);

    double along = 0, square = 0;
    for (std::size_t n = 0; n < mine.size(); ++n) {
      const Real3 traction = mode(normal(mine[n]));
      for (int d = 0; d < 3; ++d) along += traction[d] * velocity[3 * n + d];
      square += dot(traction, traction);
    }
    reduce(MPI_SUM, along, square);
    return along / square / radius;
  }
};

/// Tractions that twist the halves of a ball against each other move it with their size times a /
/// ((l - 1) eta_i + (l + 2) eta), l = 2 (Lamb, Hydrodynamics, 1932, sections 335-336).
TEST(DoubleLayer, TwistedBall)
{
  for (KernelKind kernel : kernels)
    for (double contrast : {0.2, 5.0, 20.0}) {
      FluidBall ball(8, kernel, 40, contrast);
      EXPECT_NEAR((contrast + 4) * ball.response(twist), 1, 0.01);
    }
}

/// What markers see of a layer that moves as a whole is the same in all directions but for the
/// place of their kernels on the grid: half of it, and less by a share that the curvature sets.
TEST(DoubleLayer, HalfIsSeen)
{
  for (KernelKind kernel : kernels)
    for (double radius : {5.0, 10.0}) {
      FluidBall ball(radius, kernel, 40, 2);
      double mean = 0;
      for (int m : ball.mine)
        for (int d = 0; d < 3; ++d) mean += ball.seen[m][d] / (3 * ball.points.count());
      const double curved = radius * (0.5 - sum(mean));
      EXPECT_NEAR(curved, kernel == KernelKind::roma3 ? 0.3 : 0.41, 0.03);
    }
}

/// Two planes between plates, the fluid between them of another viscosity.
struct Slab {
  static constexpr int sides = 2, rows = 16;

  Grid grid;
  KernelKind kernel;
  double contrast;
  std::array<double, sides> height;
  Points points;
  std::vector<Real3> step;
  ForcedFlow flow;

  Slab(int cells, KernelKind kernel, double contrast) :
      grid{{8, 8, cells}, {0, 0, 0}, {4.0 / cells, 4.0 / cells, 4.0 / cells}, true}, kernel(kernel),
      contrast(contrast), height{1.27, 2.61},
      flow(grid, even(grid, {1, 1, ranks()}), width, FlowEquations{})
  {
    const double side = 8 * grid.spacing[0], each = side / rows;
    for (int n = 0; n < sides; ++n)
      for (int i = 0; i < rows; ++i)
        for (int j = 0; j < rows; ++j) {
          points.position.push_back({(i + 0.3) * each, (j + 0.6) * each, height[n]});
          step.push_back({0, 0, (contrast - 1) * each * each * (n == 0 ? -1 : 1)});
        }
    points.force.assign(points.count(), {0, 0, 0});
    assign(points, grid, flow.decomposition());
  }

  /// What both planes see along x, in the mean over their markers, where they move along x with
  /// these velocities and the upper plate with `plate`.
  std::array<double, sides> see(const std::array<double, sides> &moves, double plate)
  {
    const MarkerSet markers = points.markers(kernel, MarkerKind::layers);
    std::vector<Real3> velocity(points.count(), {0, 0, 0}), result = velocity;
    for (int m = 0; m < points.count(); ++m) velocity[m][0] = moves[m / (rows * rows)];
    flow.clear_force();
    flow.forcing.plates.upper = {plate, 0, 0};
    EXPECT_EQ(flow.spread(markers, DoubleLayer{numbers(velocity), numbers(step)}), -1);
    flow.accumulate_ghosts();
    flow.solve();
    flow.fill_ghosts();
    flow.interpolate(markers, numbers(result));
    std::array<double, sides> seen{0, 0};
    for (int m : points.index) seen[m / (rows * rows)] += result[m][0] / (rows * rows);
    reduce(MPI_SUM, seen[0], seen[1]);
    return seen;
  }

  /// The planes' velocities where the upper plate moves with 1: (1 + e) U = what they see, with e
  /// what they see of a layer that moves with 1. The flow is then theirs.
  std::array<double, sides> solve()
  {
    const auto unit = see({1, 1}, 0), first = see({1, 0}, 0), second = see({0, 1}, 0),
               driven = see({0, 0}, 1);
    const double a = 1 + unit[0] - first[0], b = -second[0], c = -first[1],
                 d = 1 + unit[1] - second[1];
    const double determinant = a * d - b * c;
    const std::array<double, sides> moves{(d * driven[0] - b * driven[1]) / determinant,
                                          (a * driven[1] - c * driven[0]) / determinant};
    see(moves, 1);
    const double mean = (contrast - 1) * (height[1] - height[0]) / 4;
    const MarkerSet markers = points.markers(kernel, MarkerKind::layers);
    EXPECT_EQ(flow.find_excess(markers, numbers(step), mean, {-1, 1e3}), -1);
    return moves;
  }
};

/// Shear flow of two viscosities: the stress is the same everywhere. On the grid, too, where
/// kernels meet neither each other nor the plates.
TEST(DoubleLayer, SlabInShear)
{
  for (KernelKind kernel : kernels)
    for (int cells : {16, 32})
      for (double contrast : {0.1, 0.5, 5.0, 100.0}) {
        Slab slab(cells, kernel, contrast);
        const auto moves = slab.solve();
        const double lower = slab.height[0], inside = slab.height[1] - lower;
        const double stress = 1 / (4 - inside + inside / contrast);
        EXPECT_NEAR(moves[0], stress * lower, 1e-12);
        EXPECT_NEAR(moves[1], stress * (lower + inside / contrast), 1e-12);
        const auto plates = slab.flow.diagnose();
        EXPECT_NEAR(plates.lower_traction[0], stress, 1e-12);
        EXPECT_NEAR(plates.upper_traction[0], -stress, 1e-12);
      }
}

}    // namespace
