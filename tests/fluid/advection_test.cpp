// The discrete div(u u): closed forms, and what it conserves.

#include "fluid/advection.h"
#include "fluid/plates.h"
#include "manufactured.h"

using namespace test;

namespace {

Grid box(int n, bool walls)
{
  return {{n, n + 2, n - 2}, {0.3, -5, 2}, {2 * pi / n, 2 * pi / (n + 2), 2 * pi / (n - 2)}, walls};
}

/// A field of these velocities on brick and ghosts alike.
template <typename Value> VectorField everywhere(const Grid &grid, const Box &stored, Value value)
{
  VectorField field(stored);
  set_vector(field, grid, stored, value);
  return field;
}

/// u = u0 + G x: div(u u) = G u + u trace(G).
TEST(Advection, IsExactForLinearVelocities)
{
  const Grid grid = box(8, false);
  const Decomposition decomposition = even(grid, {1, 1, ranks()});
  const Halo halo(grid, decomposition, 1);
  const auto gradient = [](int c, int d) { return noise(7, c, d); };
  const auto velocity = [&](int c, const Real3 &x) {
    double u = noise(8, c);
    for (int d = 0; d < 3; ++d) u += gradient(c, d) * x[d];
    return u;
  };
  const VectorField u = everywhere(grid, halo.box(), velocity), result(halo.box());
  add_advection(grid, decomposition.mine(), u, -2, result);
  Error error;
  for_each(decomposition.mine(), [&](int i, int j, int k) {
    for (int c = 0; c < 3; ++c) {
      const Real3 x = location(grid, c, i, j, k);
      double expected = 0;
      for (int d = 0; d < 3; ++d)
        expected += gradient(c, d) * velocity(d, x) + gradient(d, d) * velocity(c, x);
      error.add(result[c](i, j, k) + 2 * expected);
    }
  });
  EXPECT_LT(error.over_ranks().largest, 1e-12);
}

/// The velocity with its ghosts, beyond plates that move too.
struct Extended {
  Extended(const Grid &grid, const Decomposition &decomposition, const PlateVelocities &walls) :
      grid(grid), brick(decomposition.mine()), walls(walls), halo(grid, decomposition, 1),
      velocity(halo.box()), advection(halo.box())
  {
  }

  void advect()
  {
    halo.fill(velocity.views());
    if (grid.plates) reflect_velocity(grid, walls, velocity);
    add_advection(grid, brick, velocity, 1, advection);
  }

  Grid grid;
  Box brick;
  PlateVelocities walls;
  Halo halo;
  VectorField velocity, advection;
};

TEST(Advection, IsOfSecondOrder)
{
  for (bool walls : {false, true}) {
    Manufactured moving, slow;
    moving.walls = slow.walls = walls;
    slow.inertia = Inertia::unsteady;
    const double t = 0.3;
    const auto error = [&](int n) {
      const Grid grid = moving.grid({n, n, n});
      Extended flow(grid, even(grid, {1, ranks(), 1}),
                    {moving.plate(false, t), moving.plate(true, t)});
      set_vector(flow.velocity, grid, flow.brick,
                 [&](int c, const Real3 &x) { return moving.velocity(c, x, t); });
      flow.advect();
      Error error;
      for_each(flow.brick, [&](int i, int j, int k) {
        for (int c = 0; c < 3; ++c) {
          const Real3 x = location(grid, c, i, j, k);
          if (walls && c == 2 && k == 0) continue;
          error.add(moving.density * flow.advection[c](i, j, k) -
                    (moving.force(c, x, t) - slow.force(c, x, t)));
        }
      });
      return error.over_ranks().rms();
    };
    EXPECT_NEAR(order(error(16), error(32)), 2, 0.05) << (walls ? "plates" : "periodic");
  }
}

/// For a velocity without divergence: neither energy nor, in a periodic box, momentum is made.
TEST(Advection, ConservesEnergyAndMomentum)
{
  for (bool walls : {false, true}) {
    const Grid grid = box(8, walls);
    for (const auto &[name, decomposition] : layouts(grid)) {
      SCOPED_TRACE(describe(grid) + ", " + name);
      ForcedFlow noisy(grid, decomposition, 1, FlowEquations{1, 1, Inertia::unsteady});
      set_noise_velocity(noisy, 1, 1);
      Extended flow(grid, decomposition, {});
      for (int c = 0; c < 3; ++c) set(flow.velocity[c], flow.brick, noisy.velocity()[c]);
      flow.advect();
      double power = dot(flow.velocity, flow.advection, flow.brick);
      double scale = dot(flow.advection, flow.advection, flow.brick);
      Real3 momentum{};
      for (int c = 0; c < 3; ++c)
        for_each(flow.brick,
                 [&](int i, int j, int k) { momentum[c] += flow.advection[c](i, j, k); });
      reduce(MPI_SUM, power, scale, momentum[0], momentum[1], momentum[2]);
      EXPECT_LT(std::abs(power), 1e-14 * std::sqrt(scale * grid.size()));
      for (int c = 0; c < (walls ? 0 : 3); ++c)
        EXPECT_LT(std::abs(momentum[c]), 1e-14 * std::sqrt(scale * grid.size()));
    }
  }
}

TEST(FastestCell, IsFoundAndNaNToo)
{
  const Grid grid = box(8, false);
  const Box brick = grid.domain();
  VectorField u = noise_field(brick, brick, 1);
  u[0](3, 4, 2) = -2;
  u[1](3, 4, 2) = 1.5;
  u[2](3, 4, 2) = -1;
  const FastestCell fastest = fastest_cell(grid, brick, u);
  EXPECT_EQ(fastest.cell, (Index3{3, 4, 2}));
  EXPECT_DOUBLE_EQ(fastest.rate, 2 / grid.spacing[0] + 1.5 / grid.spacing[1] + 1 / grid.spacing[2]);
  u[2](5, 6, 1) = undefined;
  const FastestCell broken = fastest_cell(grid, brick, u);
  EXPECT_TRUE(std::isnan(broken.rate));
  EXPECT_EQ(broken.cell, (Index3{5, 6, 1}));
}

}    // namespace
