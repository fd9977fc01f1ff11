// Triply periodic Stokes flow: order of accuracy against an exact flow, and residuals of the
// discrete equations.

#include "stokes_support.h"

using namespace test;

namespace {

/// A sum of waves u = a cos(k x + phase), a across k, and p = b sin(k x + phase).
struct Waves {
  double viscosity, shift;
  Forcing forcing{};

  static constexpr Real3 length{1.0, 1.6, 0.7};
  struct Wave {
    Real3 k, a;
    double b, phase;
  };
  std::vector<Wave> waves;

  Waves(double viscosity, double shift) : viscosity(viscosity), shift(shift)
  {
    for (const Index3 &m :
         {Index3{1, 0, 0}, Index3{0, 1, 1}, Index3{1, -2, 1}, Index3{-1, 1, 2}, Index3{2, 1, -1}}) {
      const int n = static_cast<int>(waves.size());
      Wave wave;
      for (int d = 0; d < 3; ++d) wave.k[d] = 2 * pi * m[d] / length[d];
      const Real3 &k = wave.k, a{noise(n, 0), noise(n, 1), noise(n, 2)};
      for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        wave.a[d] = (k[e] * a[f] - k[f] * a[e]) / std::sqrt(square(k));
      }
      wave.b = 3 * noise(n, 3);
      wave.phase = 2 * pi * noise(n, 4);
      waves.push_back(wave);
    }
  }

  static double square(const Real3 &k) { return k[0] * k[0] + k[1] * k[1] + k[2] * k[2]; }
  static double angle(const Wave &wave, const Real3 &x)
  {
    return wave.k[0] * x[0] + wave.k[1] * x[1] + wave.k[2] * x[2] + wave.phase;
  }

  double velocity(int c, const Real3 &x) const
  {
    double sum = 0;
    for (const Wave &wave : waves) sum += wave.a[c] * std::cos(angle(wave, x));
    return sum;
  }
  double pressure(const Real3 &x) const
  {
    double sum = 0;
    for (const Wave &wave : waves) sum += wave.b * std::sin(angle(wave, x));
    return sum;
  }
  double force(int c, const Real3 &x) const
  {
    double sum = 0;
    for (const Wave &wave : waves)
      sum += ((shift + viscosity * square(wave.k)) * wave.a[c] + wave.b * wave.k[c]) *
             std::cos(angle(wave, x));
    return sum;
  }
};

Grid grid_of(const Index3 &cells)
{
  Grid grid{cells, {0.3, -5, 2}, {}};
  for (int d = 0; d < 3; ++d) grid.spacing[d] = Waves::length[d] / cells[d];
  return grid;
}

void expect_second_order(const Waves &exact)
{
  std::array<FlowErrors, 3> e;
  for (int level = 0; level < 3; ++level) {
    const int n = 16 << level;
    const Grid grid = grid_of({n, n * 5 / 4, n * 3 / 4});
    e[level] = errors(exact, grid, even(grid, {1, 1, ranks()}));
  }
  for (int level = 0; level < 2; ++level) {
    const double tolerance = level == 0 ? 0.1 : 0.05;
    const FlowErrors &coarse = e[level], &fine = e[level + 1];
    EXPECT_NEAR(order(coarse.velocity.largest, fine.velocity.largest), 2, tolerance);
    EXPECT_NEAR(order(coarse.velocity.rms(), fine.velocity.rms()), 2, tolerance);
    EXPECT_NEAR(order(coarse.pressure.largest, fine.pressure.largest), 2, tolerance);
    EXPECT_NEAR(order(coarse.pressure.rms(), fine.pressure.rms()), 2, tolerance);
  }
  EXPECT_LT(e[2].velocity.largest, 0.01);
}

TEST(StokesPeriodic, SteadyFlowIsOfSecondOrder)
{
  expect_second_order({0.7, 0});
}
TEST(StokesPeriodic, ShiftedFlowIsOfSecondOrder)
{
  expect_second_order({0.7, 40});
}

/// Compared with the force: every mode at once, to round-off.
void expect_solved(const Grid &grid, const Decomposition &decomposition, double shift)
{
  StokesCase stokes(grid, decomposition, 0.4, shift);
  stokes.solve_noise();
  const auto r = stokes.residual();
  EXPECT_LT(r.momentum, 1e-12 * r.force);
  EXPECT_LT(r.divergence, 1e-13 * r.gradient);
  EXPECT_NEAR(r.mean_pressure, 0, 1e-12);
}

/// On sizes even, odd, prime and flat; flat ones leave ranks without modes.
TEST(StokesPeriodic, SolvesTheDiscreteEquationsToRoundOff)
{
  for (const Index3 &cells : {Index3{16, 12, 10}, Index3{15, 8, 9}, Index3{7, 13, 11},
                              Index3{64, 4, 4}, Index3{4, 4, 64}}) {
    const Grid grid = grid_of(cells);
    for (const auto &[name, decomposition] : layouts(grid)) {
      SCOPED_TRACE(describe(grid) + ", " + name);
      expect_solved(grid, decomposition, 0);
    }
    for (double shift : {0.3, 1e6}) expect_solved(grid, even(grid, {1, 1, ranks()}), shift);
  }
}

TEST(StokesPeriodic, SolvesExtremeCases)
{
  struct Extreme {
    Real3 spacing;
    double viscosity, shift;
  };
  for (const Extreme &e :
       {Extreme{{1, 1, 1}, 1e-12, 0}, Extreme{{1, 1, 1}, 1e12, 0}, Extreme{{1, 1, 1}, 1e-12, 1},
        Extreme{{1e-6, 1e-6, 1e-6}, 1, 0}, Extreme{{100, 1, 0.01}, 1, 0}}) {
    const Grid grid{{12, 10, 9}, {0, 0, 0}, e.spacing, false};
    SCOPED_TRACE(e.viscosity);
    StokesCase stokes(grid, even(grid, {1, 1, ranks()}), e.viscosity, e.shift);
    stokes.solve_noise();
    const auto r = stokes.residual();
    EXPECT_LT(r.momentum, 1e-13 * r.term);
    EXPECT_LT(r.divergence, 1e-13 * r.gradient);
  }
}

TEST(StokesPeriodic, AUniformForceMovesNothingUnlessThereIsAShift)
{
  const Grid grid = grid_of({8, 9, 10});
  for (double shift : {0.0, 2.0}) {
    StokesCase stokes(grid, even(grid, {1, 1, ranks()}), 0.4, shift);
    stokes.solve([](int c, const Real3 &) { return c + 1.0; });
    Error error;
    for (int c = 0; c < 3; ++c)
      for_each(stokes.brick(), [&](int i, int j, int k) {
        error.add(stokes.velocity()[c](i, j, k) - (shift > 0 ? (c + 1) / shift : 0));
      });
    EXPECT_LT(error.over_ranks().largest, 1e-14);
  }
}

}    // namespace
