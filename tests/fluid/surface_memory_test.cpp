#include "rigid_scene.h"

namespace {

using namespace test;

constexpr double radius = 6;

/// A tube with a force that moves along its wall.
struct Tube : Scene {
  explicit Tube(const Grid &grid) :
      Scene(grid, even(grid, {1, 1, ranks()}), KernelKind::peskin4, {tube(grid, radius, 1.2)}, true,
            1e-3)
  {
    RigidSurface::Settings settings = surface.settings();
    settings.most_directions = 3;    // so that others take their places
    surface.set_settings(settings);
    surface.set_markers(flow, kernel, surface.count(), position.data(), body.data());
  }

  void evaluate(double time, double strength = 20)
  {
    const Grid &grid = flow.grid();
    const Real3 x0{1 + 0.5 * time, 0.5 * grid.cells[1] + 0.75 * radius, 0.5 * grid.cells[2]};
    solve(
        [&](int c, const Real3 &x) {
          double square = 0;
          for (int d = 0; d < 3; ++d) square += std::pow(x[d] - x0[d], 2);
          return (c == 0 && from_axis(grid, x) < radius ? 1.0 : 0.0) +
                 (c == 1 ? strength : 0) * std::exp(-square / 4);
        },
        at_rest, time);
  }

  std::vector<double> forces()
  {
    return {surface.force(), surface.force() + 3 * std::size_t(surface.count())};
  }
};

/// Bit for bit, and so are all evaluations that follow.
TEST(SurfaceMemory, EvaluationsThatAreTakenBackLeaveNothing)
{
  const Grid grid = around_tube(radius, 12);
  Tube plain(grid), disturbed(grid);
  for (int n = 0; n < 6; ++n) {
    plain.evaluate(n);
    disturbed.evaluate(n);
    const auto before = disturbed.forces();
    disturbed.surface.hold();
    for (double time : {1.0 * n, n + 3.0, n + 4.5}) disturbed.evaluate(time, -50);
    EXPECT_NE(disturbed.forces(), before);
    disturbed.surface.restore();
    EXPECT_EQ(disturbed.forces(), before);
    EXPECT_EQ(plain.forces(), before);
  }
}

/// Times may count from another moment. Without directions the next evaluation is only as exact as
/// its tolerance.
TEST(SurfaceMemory, AnotherSurfaceGoesOn)
{
  const Grid grid = around_tube(radius, 12);
  for (bool directions : {true, false}) {
    Tube first(grid), second(grid);
    for (int n = 0; n < 5; ++n) first.evaluate(n);
    const auto of_markers = first.surface.marker_memory(directions);
    EXPECT_EQ(of_markers.size(),
              std::size_t(first.surface.count()) * first.surface.memory_of_marker(directions));
    first.surface.shift_times(4);
    second.surface.remember(first.surface.shared_memory(directions), of_markers);
    for (int n = 1; n < 4; ++n) {
      first.evaluate(n);
      second.evaluate(n);
      if (directions) {
        EXPECT_EQ(second.forces(), first.forces());
      }
    }
  }
}

/// A plane at rest in the middle between two plates: with it the flow is four times as slow as the
/// one without forces, from which the first evaluation starts.
TEST(SurfaceMemory, FirstSlipIsRelativeToTheFlowWithWalls)
{
  const Grid grid{{16, 16, 24}, {0, 0, 0}, {1, 1, 1}, true};
  for (double tolerance : {0.03, 0.1, 0.2}) {
    Points plane;
    for (int i = 0; i < 16; ++i)
      for (int j = 0; j < 16; ++j) plane.position.push_back({i + 0.1, j + 0.7, 12.3});
    Scene scene(grid, even(grid, {1, ranks(), 1}), KernelKind::peskin4, {plane}, false, tolerance);
    scene.solve([](int c, const Real3 &) { return c == 0 ? 1.0 : 0.0; }, at_rest);
    std::vector<int> index(scene.body.size());
    for (std::size_t n = 0; n < index.size(); ++n) index[n] = static_cast<int>(n);
    std::vector<double> velocity(3 * index.size());
    scene.flow.fill_ghosts();
    scene.flow.interpolate({scene.kernel, fluid::MarkerKind::points, static_cast<int>(index.size()),
                            index.data(), scene.position.data()},
                           velocity.data());
    double slip = 0;
    for (double component : velocity) slip = std::max(slip, std::abs(component));
    reduce(MPI_MAX, slip);
    std::printf("slip %.3g of the largest speed\n", slip / scene.flow.diagnose().max_speed);
    EXPECT_LT(slip, 1.001 * tolerance * scene.flow.diagnose().max_speed);
  }
}

}    // namespace
