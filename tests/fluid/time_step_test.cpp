// Steps in time follow a manufactured flow with second order in space and time.

#include "fluid/diagnostics.h"
#include "manufactured.h"

using namespace test;

namespace {

constexpr double duration = 0.8;

Decomposition slabs(const Grid &grid)
{
  return even(grid, {1, 1, ranks()});
}

struct Errors {
  Error velocity, pressure;
  double divergence;
};

/// Against the manufactured flow, with time steps in proportion to the spacing.
Errors errors(const Manufactured &exact, int n)
{
  const Index3 cells{n, n, n};
  Follower follower(exact, cells, slabs(exact.grid(cells)));
  const double dt = duration / (2 * n);
  for (int step = 0; step < 2 * n; ++step) follower.step(dt);
  return {follower.error(), follower.pressure_error(dt), follower.flow().diagnose().max_divergence};
}

class TimeStep : public testing::TestWithParam<Manufactured> {};

TEST_P(TimeStep, IsOfSecondOrderInSpaceAndTime)
{
  const Errors coarse = errors(GetParam(), 12), fine = errors(GetParam(), 24);
  EXPECT_NEAR(order(coarse.velocity.rms(), fine.velocity.rms()), 2, 0.05);
  EXPECT_GT(order(coarse.pressure.rms(), fine.pressure.rms()), 1.9);
  EXPECT_LT(fine.divergence, 1e-13);
}

/// Order from the differences of three flows on one grid, each with half the steps of the next.
/// `stretch` is the ratio of the lengths of a step and the one before, which alternate.
double order_in_time(const Manufactured &exact, Scheme scheme, int n, int steps, double stretch = 1)
{
  const Index3 cells{n, n, n};
  const Grid grid = exact.grid(cells);
  const Decomposition decomposition = slabs(grid);
  std::vector<VectorField> end;
  for (int refined = 1; refined <= 4; refined *= 2) {
    Follower follower(exact, cells, decomposition, scheme);
    const double pair = 2 * duration / (steps * refined);
    for (int step = 0; step < steps * refined; ++step)
      follower.step(pair * (step % 2 ? stretch : 1) / (1 + stretch));
    EXPECT_LT(follower.flow().diagnose().max_divergence, 1e-13);
    end.push_back(copy(follower.flow().velocity(), decomposition.mine()));
  }
  const auto rms = [&](int one, int other) {
    return difference(end[one], end[other], decomposition.mine()).rms();
  };
  return order(rms(0, 1), rms(1, 2));
}

TEST_P(TimeStep, IsOfSecondOrderInTime)
{
  EXPECT_NEAR(order_in_time(GetParam(), Scheme::coupled, 8, 40), 2, 0.05);
}

TEST_P(TimeStep, IsOfSecondOrderWithStepsThatChange)
{
  EXPECT_NEAR(order_in_time(GetParam(), Scheme::coupled, 8, 80, 2.5), 2, 0.05);
}

/// Convergence in time does not depend on what the plates do, which is in the operators.
TEST(TimeStepBesidePlatesThatSlip, IsOfSecondOrder)
{
  constexpr PlateCondition no_slip = PlateCondition::no_slip, free_slip = PlateCondition::free_slip;
  for (Inertia inertia : {Inertia::unsteady, Inertia::convective})
    for (const PlateConditions &conditions :
         {PlateConditions{free_slip, no_slip}, PlateConditions{no_slip, free_slip},
          PlateConditions{free_slip, free_slip}}) {
      Manufactured exact;
      exact.inertia = inertia;
      exact.conditions = conditions;
      const Errors coarse = errors(exact, 12), fine = errors(exact, 24);
      EXPECT_NEAR(order(coarse.velocity.rms(), fine.velocity.rms()), 2, 0.05);
      EXPECT_GT(order(coarse.pressure.rms(), fine.pressure.rms()), 1.9);
      EXPECT_LT(fine.divergence, 1e-13);
      if (inertia != Inertia::convective) continue;
      EXPECT_NEAR(order_in_time(exact, Scheme::projection, 8, 80), 2, 0.05);
    }
}

Manufactured equations(Inertia inertia, bool walls)
{
  Manufactured exact;
  exact.inertia = inertia;
  exact.walls = walls;
  return exact;
}

INSTANTIATE_TEST_SUITE_P(
    , TimeStep,
    testing::Values(equations(Inertia::unsteady, true), equations(Inertia::unsteady, false),
                    equations(Inertia::convective, true), equations(Inertia::convective, false)),
    [](const auto &info) {
      return std::string(info.param.inertia == Inertia::unsteady ? "Unsteady" : "Convective") +
             (info.param.walls ? "BetweenPlates" : "Periodic");
    });

TEST(Projection, IsOfSecondOrderInTime)
{
  for (Inertia inertia : {Inertia::unsteady, Inertia::convective})
    for (double viscosity : {0.05, 1.0}) {
      Manufactured exact = equations(inertia, true);
      exact.viscosity = viscosity;
      EXPECT_NEAR(order_in_time(exact, Scheme::projection, 8, 80), 2, 0.05);
      EXPECT_NEAR(order_in_time(exact, Scheme::projection, 8, 80, 2.5), 2, 0.1);
    }
}

}    // namespace
