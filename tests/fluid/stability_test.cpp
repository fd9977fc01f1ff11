// Steps of any length do not blow up without convection; with it the Courant number has a limit.

#include "flow_support.h"
#include "fluid/diagnostics.h"

#include <complex>

using namespace test;

namespace {

Grid grid_of(bool walls)
{
  return {{8, 6, 8}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, walls};
}

struct Case {
  std::string name;
  bool walls;
  Scheme scheme;
};

const std::vector<Case> &cases()
{
  static const std::vector<Case> cases{{"periodic", false, Scheme::coupled},
                                       {"plates", true, Scheme::coupled},
                                       {"projection", true, Scheme::projection}};
  return cases;
}

/// From 1e-4 to 1e8, in units of spacing^2 / nu.
template <typename Visit> void for_each_time_step(const Grid &grid, Visit visit)
{
  for (double number = 1e-4; number < 2e8; number *= 10) {
    SCOPED_TRACE("viscous Courant number " + std::to_string(number));
    visit(number * grid.spacing[2] * grid.spacing[2]);
  }
}

/// Distance from the steady flow of the same forces and plates: by the coupled scheme it never
/// grows.
TEST(Stability, UnsteadyFlowComesCloserToTheSteadyOne)
{
  for (const Case &which : cases()) {
    SCOPED_TRACE(which.name);
    const Grid grid = grid_of(which.walls);
    const Decomposition decomposition = even(grid, {1, 1, ranks()});
    ForcedFlow steady(grid, decomposition, 1, FlowEquations{1});
    set_noise_force(steady, 1);
    steady.forcing.plates = {{0.4, 0.1, 0}, {-0.5, 0.2, 0}};
    steady.solve();
    for_each_time_step(grid, [&](double dt) {
      ForcedFlow flow(grid, decomposition, 1, FlowEquations{1, 1, Inertia::unsteady, which.scheme});
      set_noise_velocity(flow, 2, 1);
      set_noise_force(flow, 1);
      flow.forcing = steady.forcing;
      const auto distance = [&] {
        return difference(flow.velocity(), steady.velocity(), flow.brick()).rms();
      };
      const double first = distance();
      double before = first, rise = 0;
      for (int n = 0; n < 60; ++n) {
        step(flow, dt);
        const double now = distance();
        rise = std::max(rise, now - (which.scheme == Scheme::coupled ? before : first));
        before = now;
      }
      EXPECT_LT(rise, 1e-11 * first);
    });
  }
}

/// The velocity that moves the markers, under forces and plates that change at random from step to
/// step.
TEST(Stability, VelocityInTheMiddleOfAStepIsBounded)
{
  constexpr int steps = 60;
  for (const Case &which : cases()) {
    SCOPED_TRACE(which.name);
    const Grid grid = grid_of(which.walls);
    const Decomposition decomposition = even(grid, {1, 1, ranks()});
    const auto drive = [](ForcedFlow &flow, int n) {
      set_noise_force(flow, n);
      flow.forcing.plates = {{0.2 * noise(n), 0.1, 0}, {0, 0.2 * noise(n, 1), 0}};
    };
    double steadily = 0;
    ForcedFlow steady(grid, decomposition, 1, FlowEquations{1});
    for (int n = 0; n < steps; ++n) {
      drive(steady, n);
      steady.solve();
      steadily = std::max(steadily, steady.diagnose().max_speed);
    }
    for_each_time_step(grid, [&](double dt) {
      ForcedFlow flow(grid, decomposition, 1, FlowEquations{1, 1, Inertia::unsteady, which.scheme});
      double fastest = 0;
      for (int n = 0; n < steps; ++n) {
        drive(flow, n);
        flow.start_step(dt);
        fastest = std::max(fastest, flow.diagnose().max_speed);
        flow.finish_step();
      }
      EXPECT_LT(fastest, 1.5 * steadily);
    });
  }
}

/// Convection by Adams-Bashforth, viscosity by Crank-Nicolson, with i c and -d their symbols times
/// the step:
///   (1 + d/2) G^2 - (1 - d/2 - 3/2 i c) G - i c/2 = 0.
double amplification(double c, double d)
{
  using Complex = std::complex<double>;
  const Complex middle{1 - d / 2, -1.5 * c}, last{0, c / 2};
  const Complex root = std::sqrt(middle * middle + 4 * (1 + d / 2) * last);
  return std::max(std::abs(middle + root), std::abs(middle - root)) / (2 + d);
}

/// A wave of four cells across a uniform flow, of which convection is the fastest.
double growth(double courant, double reynolds)
{
  const Grid grid{{8, 4, 4}, {0, 0, 0}, {1, 1, 1}, false};
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 0,
                  FlowEquations{1 / reynolds, 1, Inertia::convective});
  flow.forcing.mean = {1, 0, 0};
  flow.set_velocity([&](int c, int i, int, int) {
    return c == 0 ? 1 : c == 2 ? std::cos(pi / 2 * i) : 0;
  });
  const auto amplitude = [&] {
    Error wave;
    for_each(flow.brick(), [&](int i, int j, int k) { wave.add(flow.velocity()[2](i, j, k)); });
    return wave.over_ranks().rms();
  };
  const int settle = 60, steps = 20;
  for (int n = 0; n < settle; ++n) step(flow, courant);
  const double before = amplitude();
  for (int n = 0; n < steps; ++n) step(flow, courant);
  return std::pow(amplitude() / before, 1.0 / steps);
}

TEST(Stability, ConvectionIsAmplifiedAsTheSchemeSays)
{
  for (double reynolds : {10.0, 100.0, 1e4})
    for (double courant : {0.05, 0.2, 0.4, 0.6})
      EXPECT_NEAR(growth(courant, reynolds), amplification(courant, 2 * courant / reynolds), 1e-12)
          << "Courant number " << courant << ", Reynolds number of the grid " << reynolds;
}

/// The limit is near (8 / Re)^(1/3) at a large Reynolds number Re of the grid.
TEST(Stability, OfConvectionHasALimit)
{
  for (double reynolds : {1e2, 1e3, 1e4}) {
    const double limit = std::cbrt(8 / reynolds);
    EXPECT_LT(growth(0.85 * limit, reynolds), 1);
    EXPECT_GT(growth(1.05 * limit, reynolds), 1);
  }
}

/// Long after the start, with steps as long as the fastest cell lets them.
TEST(Stability, ConvectiveFlowBelowTheLimitLosesEnergy)
{
  for (bool walls : {false, true}) {
    const Grid grid = grid_of(walls);
    ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1,
                    FlowEquations{1e-3, 1, Inertia::convective});
    set_noise_velocity(flow, 3, 1);
    double before = flow.diagnose().kinetic_energy_per_density, rise = 0;
    const double first = before;
    for (int n = 0; n < 1000; ++n) {
      const double rate = max(fastest_cell(grid, flow.brick(), flow.velocity()).rate);
      step(flow, 0.3 / rate);
      const double energy = flow.diagnose().kinetic_energy_per_density;
      rise = std::max(rise, energy / before - 1);
      before = energy;
    }
    EXPECT_LT(rise, 1e-3) << describe(grid);
    EXPECT_LT(before, first) << describe(grid);
  }
}

}    // namespace
