// Memory and messages: what a flow does not need it does not have.

#include "flow_support.h"

using namespace test;

namespace {

Grid grid_of(bool walls)
{
  return {{12, 10, 8}, {0, 0, 0}, {0.5, 0.4, 0.3}, walls};
}

FlowEquations equations(Inertia inertia, Scheme scheme = Scheme::coupled)
{
  return {0.7, 1.3, inertia, scheme};
}

constexpr std::array<Inertia, 3> regimes{Inertia::none, Inertia::unsteady, Inertia::convective};

template <typename Visit> void for_each_layout(Visit visit)
{
  for (bool walls : {false, true}) {
    const Grid grid = grid_of(walls);
    for (const auto &[name, decomposition] : layouts(grid)) {
      SCOPED_TRACE(describe(grid) + ", " + name);
      visit(grid, decomposition);
    }
  }
}

TEST(Memory, GrowsByAFieldForEachThingToRemember)
{
  for_each_layout([](const Grid &grid, const Decomposition &decomposition) {
    const std::size_t field = 3 * sizeof(double) * Halo(grid, decomposition, 1).box().size();
    const std::size_t brick = 3 * sizeof(double) * decomposition.mine().size();
    std::size_t expected = ForcedFlow(grid, decomposition, 0, equations(Inertia::none)).bytes();
    for (Inertia inertia : regimes) {
      ForcedFlow bare(grid, decomposition, 0, equations(inertia));
      EXPECT_EQ(bare.bytes(), expected);
      EXPECT_EQ(ForcedFlow(grid, decomposition, 1, equations(inertia)).bytes(), expected + field);
      if (inertia != Inertia::none)
        for (int n = 0; n < 4; ++n) step(bare, 0.1);
      else
        bare.solve();
      EXPECT_EQ(bare.bytes(), expected) << "steps need memory";
      expected += inertia == Inertia::none ? field : brick;
    }
  });
}

TEST(Memory, OfAProjectionIsThePressureBetweenPlates)
{
  for_each_layout([](const Grid &grid, const Decomposition &decomposition) {
    double coupled = ForcedFlow(grid, decomposition, 0, equations(Inertia::unsteady)).bytes();
    double projected =
        ForcedFlow(grid, decomposition, 0, equations(Inertia::unsteady, Scheme::projection))
            .bytes();
    reduce(MPI_SUM, coupled, projected);
    const int modes = (grid.cells[0] / 2 + 1) * grid.cells[1] * grid.cells[2];
    EXPECT_EQ(projected - coupled, grid.plates ? modes * sizeof(std::complex<double>) : 0);
  });
}

TEST(Memory, OfPressureAndResponsesComesWithTheFirstUse)
{
  for_each_layout([](const Grid &grid, const Decomposition &decomposition) {
    const std::size_t scalar = sizeof(double) * Halo(grid, decomposition, 2).box().size();
    const auto added = [](ForcedFlow &flow, const auto &use) {
      const std::size_t before = flow.bytes();
      use();
      const std::size_t once = flow.bytes();
      use();
      EXPECT_EQ(flow.bytes(), once);
      return once - before;
    };
    for (Inertia inertia : {Inertia::unsteady, Inertia::convective}) {
      ForcedFlow flow(grid, decomposition, 2, equations(inertia));
      step(flow, 0.1);
      EXPECT_EQ(added(flow, [&] { flow.apply_mobility({KernelKind::roma3}, nullptr, nullptr); }),
                6 * scalar);
      const std::size_t rhs =
          inertia == Inertia::unsteady ? 3 * sizeof(double) * decomposition.mine().size() : 0;
      double modes = added(flow, [&] { flow.pressure(); }) - scalar - rhs;
      reduce(MPI_SUM, modes);
      EXPECT_EQ(modes, (grid.cells[0] / 2 + 1) * grid.cells[1] * grid.cells[2] *
                           sizeof(std::complex<double>));
    }
  });
}

TEST(Memory, OfSheetsIsThatOfTheModesAndThreePlanes)
{
  constexpr int layers = 2;
  for_each_layout([](const Grid &grid, const Decomposition &decomposition) {
    const Box box = Halo(grid, decomposition, layers).box();
    ForcedFlow flow(grid, decomposition, layers, equations(Inertia::none), true);
    const std::size_t before = flow.bytes();
    flow.solve();
    flow.fill_ghosts();
    flow.interpolate(Points().markers(KernelKind::roma3, MarkerKind::sheets), nullptr);
    EXPECT_EQ(flow.bytes() - before, 3 * sizeof(double) * box.extent(0) * box.extent(1));
  });
}

struct Sent {
  long messages, bytes;

  friend bool operator==(const Sent &a, const Sent &b)
  {
    return a.messages == b.messages && a.bytes == b.bytes;
  }
  friend Sent operator+(const Sent &a, const Sent &b)
  {
    return {a.messages + b.messages, a.bytes + b.bytes};
  }
};

template <typename Work> Sent sent(const ForcedFlow &flow, Work work)
{
  const Traffic before = flow.traffic();
  work();
  const Traffic after = flow.traffic();
  return {after.messages - before.messages, after.bytes - before.bytes};
}

/// The transforms of a solve, and with convection the ghosts of one velocity.
TEST(Traffic, OfAStepWithoutMarkers)
{
  for_each_layout([](const Grid &grid, const Decomposition &decomposition) {
    ForcedFlow steady(grid, decomposition, 0, equations(Inertia::none));
    const Sent solve = sent(steady, [&] { steady.solve(); });
    const Sent ghosts = sent(steady, [&] { steady.fill_ghosts(); });
    EXPECT_EQ(sent(steady, [&] { steady.fill_ghosts(); }), (Sent{0, 0}));
    for (Inertia inertia : {Inertia::unsteady, Inertia::convective}) {
      ForcedFlow flow(grid, decomposition, 0, equations(inertia));
      for (int n = 0; n < 4; ++n) {
        Sent expected = n < 2 ? solve + solve : solve;
        if (inertia == Inertia::convective) expected = expected + ghosts;
        EXPECT_EQ(sent(flow,
                       [&] {
                         flow.start_step(0.1);
                         flow.finish_step();
                       }),
                  expected)
            << "step " << n;
      }
      if (decomposition.ranks() == 1) {
        EXPECT_EQ(flow.traffic().messages, 0);
      }
    }
  });
}

}    // namespace
