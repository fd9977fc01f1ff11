// Stokes flow between two plates: order of accuracy against an exact flow, residuals of the
// discrete equations, plane Couette and Poiseuille flow, and extreme grids and constants.

#include "stokes_support.h"

using namespace test;

namespace {

/// Polynomial of zeta = z / height, and its derivatives in z.
struct Profile {
  std::vector<double> coefficients;

  double operator()(double zeta, int derivative = 0) const;
};

constexpr double height = 0.8;

double Profile::operator()(double zeta, int derivative) const
{
  double sum = 0;
  for (int n = static_cast<int>(coefficients.size()) - 1; n >= derivative; --n) {
    double term = coefficients[n];
    for (int m = n; m > n - derivative; --m) term *= m / height;
    sum = sum * zeta + term;
  }
  return sum;
}

/// With theta = kx x + ky y + phase and k = |(kx, ky)|, for each wave
///   w = W(z) cos(theta),  along k: -W'(z) / k sin(theta),  across k: G(z) cos(theta),
///   p = P(z) cos(theta),
/// where W, its slope and G vanish on the plates; and a mean flow M(z) in x and -M(z)/2 in y,
/// plates that move and a body force.
struct WavesBetweenPlates {
  double viscosity, shift;
  Forcing forcing;

  static constexpr Real3 length{1.0, 1.3, height};
  struct Wave {
    int mx, my;
    double phase;
    Profile w, across, pressure;
  };
  std::vector<Wave> waves;
  Profile mean{{0, 1, 1, -2}}, mean_pressure{{-1. / 3, 0, 1}};
  PlateConditions conditions;
  PlateVelocities linear;    ///< part of the mean flow

  WavesBetweenPlates(double viscosity, double shift) : viscosity(viscosity), shift(shift)
  {
    forcing.plates.lower = {0.2, -0.1, 0};
    forcing.plates.upper = {-0.3, 0.4, 0};
    forcing.body = {0.7, 0.3, -0.5};
    // zeta^2 (1 - zeta)^2 (1 + 2 zeta), zeta (1 - zeta) (1 + zeta), ...
    waves.push_back({1, 0, 0.3, {{0, 0, 10, 0, -30, 20}}, {{0, 2, 0, -2}}, {{1, 1, -3}}});
    waves.push_back({1, 2, 1.1, {{0, 0, -9, 27, -27, 9}}, {{0, 1, -3, 2}}, {{0, 1, 2, -1}}});
    waves.push_back({0, -1, 2.0, {{0, 0, 8, -16, 8}}, {{0, -1, 0, 0, 1}}, {{-1, 0, 0, 2}}});
    linear = forcing.plates;
  }

  /// Where the fluid slips W, its second derivative and the slopes of G and of the mean flow
  /// vanish.
  WavesBetweenPlates(double viscosity, double shift, const PlateConditions &conditions) :
      WavesBetweenPlates(viscosity, shift)
  {
    this->conditions = conditions;
    const bool lower = conditions.lower == PlateCondition::free_slip;
    const bool upper = conditions.upper == PlateCondition::free_slip;
    if (lower && upper) {
      // zeta - 2 zeta^3 + zeta^4 and its derivative, (zeta - 3 zeta^3 + ...), ...
      waves[0].w = {{0, 4, 0, -8, 4}};
      waves[1].w = {{0, -4, 0, 0, 10, -6}};
      waves[2].w = {{0, 6, 0, -12, 6}};
      for (Wave &wave : waves) wave.across = {{1, 0, 3, -2}};
      mean = {{0.3, 0, 3, -2}};
      linear = {};
      return;
    }
    waves[0].w = {{0, 4, 0, -12, 8}};
    waves[1].w = {{0, 5, 0, -10, 0, 5}};
    waves[2].w = {{0, -6, 0, 18, -12}};
    for (Wave &wave : waves) wave.across = {{1, 0, 2, -3}};
    mean = {{1, 0, -1}};
    linear.lower = linear.upper = lower ? forcing.plates.upper : forcing.plates.lower;
    if (lower) return;
    for (Wave &wave : waves) {
      wave.w = upside_down(wave.w);
      wave.across = upside_down(wave.across);
    }
    mean = upside_down(mean);
  }

  /// The same polynomial of 1 - zeta.
  static Profile upside_down(const Profile &profile)
  {
    std::vector<double> turned;
    for (int n = static_cast<int>(profile.coefficients.size()) - 1; n >= 0; --n) {
      turned.push_back(0);
      for (int m = static_cast<int>(turned.size()) - 1; m > 0; --m)
        turned[m] = turned[m] - turned[m - 1];
      turned[0] += profile.coefficients[n];
    }
    return {turned};
  }

  static double theta(const Wave &wave, const Real3 &x)
  {
    return kx(wave) * x[0] + ky(wave) * x[1] + wave.phase;
  }
  static double kx(const Wave &wave) { return 2 * pi * wave.mx / length[0]; }
  static double ky(const Wave &wave) { return 2 * pi * wave.my / length[1]; }

  /// Component c of z2 d^2 u / dz^2 - k2 (d^2 u / dx^2 + d^2 u / dy^2) + one u.
  double combine(int c, const Real3 &x, double one, double k2, double z2) const
  {
    const double zeta = x[2] / height;
    double sum = 0;
    for (const Wave &wave : waves) {
      const double square = kx(wave) * kx(wave) + ky(wave) * ky(wave), k = std::sqrt(square);
      const auto part = [&](const Profile &profile, int derivative) {
        return z2 * profile(zeta, derivative + 2) + (one + k2 * square) * profile(zeta, derivative);
      };
      const double cosine = std::cos(theta(wave, x)), sine = std::sin(theta(wave, x));
      if (c == 0)
        sum -= kx(wave) / square * part(wave.w, 1) * sine +
               ky(wave) / k * part(wave.across, 0) * cosine;
      if (c == 1)
        sum -= ky(wave) / square * part(wave.w, 1) * sine -
               kx(wave) / k * part(wave.across, 0) * cosine;
      if (c == 2) sum += part(wave.w, 0) * cosine;
    }
    const double plates = linear.lower[c] + (linear.upper[c] - linear.lower[c]) * zeta;
    sum += one * plates;
    const double share[3]{1, -0.5, 0};
    return sum + share[c] * (z2 * mean(zeta, 2) + one * mean(zeta));
  }

  double velocity(int c, const Real3 &x) const { return combine(c, x, 1, 0, 0); }
  double pressure(const Real3 &x) const
  {
    double sum = mean_pressure(x[2] / height);
    for (const Wave &wave : waves) sum += wave.pressure(x[2] / height) * std::cos(theta(wave, x));
    return sum;
  }
  double force(int c, const Real3 &x) const
  {
    const double zeta = x[2] / height;
    double sum = combine(c, x, shift, viscosity, -viscosity) - forcing.body[c];
    if (c == 2) sum += mean_pressure(zeta, 1);
    for (const Wave &wave : waves) {
      const double cosine = std::cos(theta(wave, x)), sine = std::sin(theta(wave, x));
      if (c == 0) sum -= kx(wave) * wave.pressure(zeta) * sine;
      if (c == 1) sum -= ky(wave) * wave.pressure(zeta) * sine;
      if (c == 2) sum += wave.pressure(zeta, 1) * cosine;
    }
    return sum;
  }
};

Grid grid_of(const Index3 &cells, const PlateConditions &conditions = {})
{
  Grid grid{cells, {0, 0, 0}, {}, true, conditions};
  for (int d = 0; d < 3; ++d) grid.spacing[d] = WavesBetweenPlates::length[d] / cells[d];
  return grid;
}

using Levels = std::array<FlowErrors, 3>;

/// Errors on three grids, each of half the spacing of the one before.
Levels refined(const WavesBetweenPlates &exact)
{
  Levels e;
  for (int level = 0; level < 3; ++level) {
    const int n = 16 << level;
    const Grid grid = grid_of({n, n * 5 / 4, n}, exact.conditions);
    e[level] = errors(exact, grid, even(grid, {1, 1, ranks()}));
  }
  EXPECT_NEAR(order(e[1].velocity.rms(), e[2].velocity.rms()), 2, 0.05);
  EXPECT_NEAR(order(e[1].pressure.rms(), e[2].pressure.rms()), 2, 0.05);
  EXPECT_LT(e[2].velocity.largest, 0.015);
  return e;
}

/// The largest error stands in the cells at a plate, where its next term is of third order: the
/// order found tends to 2 linearly in h, and one extrapolation over two refinements removes that.
void expect_second_order(const WavesBetweenPlates &exact)
{
  const Levels e = refined(exact);
  const auto limit = [](double coarse, double medium, double fine) {
    return 2 * order(medium, fine) - order(coarse, medium);
  };
  EXPECT_NEAR(limit(e[0].velocity.largest, e[1].velocity.largest, e[2].velocity.largest), 2, 0.05);
  EXPECT_NEAR(limit(e[0].pressure.largest, e[1].pressure.largest, e[2].pressure.largest), 2, 0.05);
}

TEST(StokesWalls, SteadyFlowIsOfSecondOrder)
{
  expect_second_order({0.7, 0});
}
TEST(StokesWalls, FlowThatSlipsIsOfSecondOrder)
{
  constexpr PlateCondition no_slip = PlateCondition::no_slip, free_slip = PlateCondition::free_slip;
  for (double shift : {0, 40}) {
    refined({0.7, shift, {free_slip, no_slip}});
    refined({0.7, shift, {no_slip, free_slip}});
  }
  refined({0.7, 40, {free_slip, free_slip}});
}
TEST(StokesWalls, ShiftedFlowIsOfSecondOrder)
{
  expect_second_order({0.7, 40});
}

Forcing busy_forcing()
{
  Forcing forcing;
  forcing.plates.lower = {0.3, -0.2, 0};
  forcing.plates.upper = {-0.1, 0.4, 0};
  forcing.body = {0.5, 0.2, -0.7};
  return forcing;
}

/// Residuals are compared with the terms that cancel in them, of which the rounding is left.
void expect_solved(const Grid &grid, const Decomposition &decomposition, double viscosity,
                   double shift)
{
  StokesCase stokes(grid, decomposition, viscosity, shift, busy_forcing());
  stokes.solve_noise();
  const auto r = stokes.residual();
  EXPECT_LT(r.momentum, 1e-12 * r.term);
  EXPECT_LT(r.divergence, 1e-13 * r.gradient);
  EXPECT_EQ(r.plate, 0);
  EXPECT_NEAR(r.mean_pressure, 0, 1e-12 * r.term);
}

TEST(StokesWalls, SolvesTheDiscreteEquationsToRoundOff)
{
  for (const Index3 &cells :
       {Index3{16, 12, 10}, Index3{15, 8, 9}, Index3{7, 13, 16}, Index3{18, 5, 4}}) {
    const Grid grid = grid_of(cells);
    for (const auto &[name, decomposition] : layouts(grid)) {
      SCOPED_TRACE(describe(grid) + ", " + name);
      expect_solved(grid, decomposition, 0.4, 0);
    }
    expect_solved(grid, even(grid, {1, 1, ranks()}), 0.4, 3);

    StokesCase at_rest(grid, even(grid, {1, 1, ranks()}), 0.4, 0);
    at_rest.solve_noise();
    const auto r = at_rest.residual();
    EXPECT_LT(r.momentum, 1e-12 * r.force);
  }
}

TEST(StokesWalls, SolvesTheDiscreteEquationsWithSlipToRoundOff)
{
  constexpr PlateCondition no_slip = PlateCondition::no_slip, free_slip = PlateCondition::free_slip;
  for (const PlateConditions &conditions :
       {PlateConditions{free_slip, no_slip}, PlateConditions{no_slip, free_slip},
        PlateConditions{free_slip, free_slip}})
    for (const Index3 &cells : {Index3{16, 12, 10}, Index3{7, 13, 16}, Index3{18, 5, 4}}) {
      const Grid grid = grid_of(cells, conditions);
      for (const auto &[name, decomposition] : layouts(grid)) {
        SCOPED_TRACE(describe(grid) + ", " + name);
        expect_solved(grid, decomposition, 0.4, 3);
        if (conditions.hold_the_flow()) expect_solved(grid, decomposition, 0.4, 0);
      }
    }
}

TEST(StokesWalls, SolvesExtremeCases)
{
  const Real3 unit{1, 1, 1};
  struct Extreme {
    Index3 cells;
    Real3 spacing;
    double viscosity, shift;
  };
  for (const Extreme &e : {
           Extreme{{8, 8, 4}, unit, 1, 0},
           Extreme{{8, 8, 256}, unit, 1, 0},
           Extreme{{64, 48, 4}, unit, 1, 0},
           Extreme{{8, 8, 32}, {100, 1, 0.01}, 1, 0},
           Extreme{{8, 8, 32}, {0.01, 1, 100}, 1, 0},
           Extreme{{8, 8, 32}, {1000, 1000, 1}, 1, 0},
           Extreme{{8, 8, 32}, unit, 1, 1e12},
           Extreme{{8, 8, 32}, unit, 1e-12, 1},
           Extreme{{8, 8, 32}, unit, 1e-12, 0},
           Extreme{{8, 8, 32}, unit, 1e12, 0},
           Extreme{{8, 8, 32}, {1e-6, 1e-6, 1e-6}, 1, 0},
       }) {
    const Grid grid{e.cells, {0, 0, 0}, e.spacing, true};
    SCOPED_TRACE(describe(grid) + " viscosity " + std::to_string(e.viscosity));
    expect_solved(grid, even(grid, {1, 1, ranks()}), e.viscosity, e.shift);
  }
}

/// Largest deviation of u and v from profile(c, z) and of w from zero.
template <typename Exact>
double deviation(const Grid &grid, const Forcing &forcing, double viscosity, const Exact &exact)
{
  StokesCase stokes(grid, even(grid, {1, 1, ranks()}), viscosity, 0, forcing);
  stokes.solve([](int, const Real3 &) { return 0.0; });
  Error error;
  for (int c = 0; c < 3; ++c)
    for_each(stokes.brick(), [&](int i, int j, int k) {
      const double z = location(grid, c, i, j, k)[2];
      error.add(stokes.velocity()[c](i, j, k) - (c < 2 ? exact(c, z) : 0));
    });
  return error.over_ranks().largest;
}

TEST(StokesWalls, CouetteFlowIsLinear)
{
  for (int nz : {4, 17, 128}) {
    const Grid grid = grid_of({8, 6, nz});
    Forcing forcing;
    forcing.plates = busy_forcing().plates;
    const auto &[lower, upper] = forcing.plates;
    const double error =
        deviation(grid, forcing, 1.7, [&lower = lower, &upper = upper](int c, double z) {
          return lower[c] + (upper[c] - lower[c]) * z / height;
        });
    EXPECT_LT(error, 1e-13);
  }
}

/// With u beyond a plate the negative of its image, the discrete solution is the parabola plus
/// h^2/4: away from the plates second differences of a parabola are exact, and at a plate the
/// value at z = -h/2, -h H / 2, is the negative of that at z = h/2.
TEST(StokesWalls, PoiseuilleFlowIsTheDiscreteParabola)
{
  for (int nz : {4, 17, 128}) {
    const Grid grid = grid_of({8, 6, nz});
    const double viscosity = 1.7, h = grid.spacing[2];
    Forcing forcing;
    forcing.body = {0.6, -0.4, 0};
    const double error = deviation(grid, forcing, viscosity, [&](int c, double z) {
      return forcing.body[c] / (2 * viscosity) * (z * (height - z) + h * h / 4);
    });
    EXPECT_LT(error, 1e-13);
  }
}

}    // namespace
