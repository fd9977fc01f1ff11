// A flow goes on from its saved history, and on other bricks.

#include "flow_support.h"
#include "fluid/diagnostics.h"

using namespace test;

namespace {

struct Case {
  std::string name;
  FlowEquations equations;
  bool walls;
};

std::vector<Case> cases()
{
  std::vector<Case> cases;
  for (bool walls : {false, true}) {
    const std::string where = walls ? ", plates" : ", periodic";
    cases.push_back({"unsteady" + where, {0.7, 1.3, Inertia::unsteady}, walls});
    cases.push_back(
        {"convective" + where, {0.7, 1.3, Inertia::convective, Scheme::coupled, false}, walls});
  }
  cases.push_back({"projection", {0.7, 1.3, Inertia::convective, Scheme::projection}, true});
  return cases;
}

Grid grid_of(const Case &which)
{
  return {{8, 10, 12}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, which.walls};
}

/// Steps of different lengths under plates, a body force and perhaps forces that change.
void go_on(ForcedFlow &flow, int first, int last, bool forces = true)
{
  for (int n = first; n < last; ++n) {
    if (forces) set_noise_force(flow, n);
    Forcing end;
    end.plates = {{0.3 * noise(n, 0), 0.2, 0}, {0.3 * noise(n, 1), -0.1, 0}};
    end.body = {noise(n, 2), noise(n, 3), noise(n, 4)};
    step_to(flow, 0.05 * (2 + noise(n, 5)), end);
  }
}

struct State {
  VectorField velocity;
  ScalarField pressure;
};

State state(ForcedFlow &flow)
{
  return {copy(flow.velocity(), flow.brick()), copy(flow.pressure(), flow.brick())};
}

/// Largest difference of velocity and pressure.
double distance(ForcedFlow &flow, const State &expected)
{
  return std::max(difference(flow.velocity(), expected.velocity, flow.brick()).largest,
                  difference(flow.pressure(), expected.pressure, flow.brick()).largest);
}

/// What rank 0 has of a flow's history, on all ranks.
std::vector<double> saved(ForcedFlow &flow)
{
  std::vector<double> history = flow.history();
  EXPECT_EQ(history.size(), rank() == 0 ? flow.history_length() : 0);
  history.resize(flow.history_length());
  MPI_Bcast(history.data(), static_cast<int>(history.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return history;
}

/// Saved after a damped step and after others; into a new flow, and into one that has other steps
/// behind it.
TEST(History, RestoredGoesOnBitForBit)
{
  for (const Case &which : cases())
    for (int until : {1, 4}) {
      SCOPED_TRACE(which.name + ", " + std::to_string(until) + " steps");
      const Grid grid = grid_of(which);
      const Decomposition decomposition = even(grid, {1, ranks(), 1});
      ForcedFlow flow(grid, decomposition, 2, which.equations),
          fresh(grid, decomposition, 2, which.equations),
          used(grid, decomposition, 2, which.equations);
      go_on(flow, 0, until);
      go_on(used, 20, 23);
      const std::vector<double> history = saved(flow);
      for (ForcedFlow *other : {&fresh, &used}) {
        other->restore(history.data());
        other->forcing = flow.forcing;
      }
      go_on(flow, until, until + 3);
      const State expected = state(flow);
      for (ForcedFlow *other : {&fresh, &used}) {
        go_on(*other, until, until + 3);
        EXPECT_EQ(distance(*other, expected), 0);
      }
    }
}

TEST(History, OfOneRankGoesOnInEveryLayout)
{
  for (const Case &which : cases()) {
    const Grid grid = grid_of(which);
    ForcedFlow flow(grid, alone(grid), 2, which.equations);
    go_on(flow, 0, 3);
    const std::vector<double> history = flow.history();
    ASSERT_EQ(history.size(), flow.history_length());
    const Forcing drive = flow.forcing;
    go_on(flow, 3, 6);
    const State expected = state(flow);
    for (const auto &[name, decomposition] : layouts(grid)) {
      SCOPED_TRACE(which.name + ", " + name);
      ForcedFlow other(grid, decomposition, 2, which.equations);
      other.restore(history.data());
      other.forcing = drive;
      go_on(other, 3, 6);
      EXPECT_LT(distance(other, expected), 1e-12);
      const std::vector<double> again = saved(other);
      EXPECT_EQ(again.size(), history.size());
    }
  }
}

TEST(History, IsEmptyWithoutInertia)
{
  const Grid grid = grid_of({"", {}, true});
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 1, FlowEquations{0.7});
  EXPECT_EQ(flow.history_length(), 0);
  EXPECT_TRUE(flow.history().empty());
}

/// From layout to layout, among them those without markers, which then start to have forces.
TEST(TakeOver, GoesOnOnOtherBricks)
{
  for (const Case &which : cases())
    for (bool markers : {true, false}) {
      const Grid grid = grid_of(which);
      ForcedFlow reference(grid, alone(grid), 2, which.equations);
      std::vector<State> expected;
      const int steps = static_cast<int>(layouts(grid).size()) + 2;
      for (int n = 0; n < steps; ++n) {
        go_on(reference, n, n + 1, markers || n > 0);
        expected.push_back(state(reference));
      }

      auto flow = std::make_unique<ForcedFlow>(grid, even(grid, {1, 1, ranks()}), markers ? 2 : 0,
                                               which.equations);
      go_on(*flow, 0, 1, markers);
      int n = 1;
      for (const auto &[name, decomposition] : layouts(grid)) {
        SCOPED_TRACE(which.name + ", to " + name + (markers ? "" : ", without markers at first"));
        auto next = std::make_unique<ForcedFlow>(grid, decomposition, 1 + n % 3, which.equations);
        next->take_over(*flow);
        next->forcing = flow->forcing;
        EXPECT_LT(distance(*next, expected[n - 1]), 1e-12);
        go_on(*next, n, n + 1);
        EXPECT_LT(distance(*next, expected[n]), 1e-12);
        flow = std::move(next);
        ++n;
      }
    }
}

TEST(TakeOver, KeepsASteadyFlow)
{
  const Grid grid = grid_of({"", {}, true});
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 2, FlowEquations{0.7});
  set_noise_force(flow, 1);
  flow.solve();
  const State expected = state(flow);
  ForcedFlow other(grid, even(grid, {1, 1, ranks()}), 3, FlowEquations{0.7});
  other.take_over(flow);
  EXPECT_EQ(distance(other, expected), 0);
}

}    // namespace
