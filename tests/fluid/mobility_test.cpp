// What further forces on the markers would add to the flow.

#include "flow_support.h"
#include "fluid/diagnostics.h"

using namespace test;

namespace {

constexpr KernelKind kernel = KernelKind::peskin4;
constexpr int width = 4;

struct Case {
  Inertia inertia;
  bool walls;
};

Grid grid_of(const Case &c)
{
  return {{12, 10, 8}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, c.walls};
}

std::string describe(const Case &c)
{
  const char *const names[]{"none", "unsteady", "convective"};
  return std::string(names[static_cast<int>(c.inertia)]) + (c.walls ? ", plates" : ", periodic");
}

std::vector<Case> cases()
{
  std::vector<Case> cases;
  for (Inertia inertia : {Inertia::none, Inertia::unsteady, Inertia::convective})
    for (bool walls : {false, true}) cases.push_back({inertia, walls});
  return cases;
}

/// Markers and two sets of forces on them.
struct Scene {
  explicit Scene(const Case &which) :
      inertia(which.inertia), grid(grid_of(which)), decomposition(even(grid, {1, 1, ranks()})),
      points(scatter(grid, 40, 1))
  {
    assign(points, grid, decomposition);
    for (int n = 0; n < points.count(); ++n)
      other.push_back({noise(9, n, 0), noise(9, n, 1), noise(9, n, 2)});
  }

  std::unique_ptr<ForcedFlow> flow() const
  {
    auto flow =
        std::make_unique<ForcedFlow>(grid, decomposition, width, FlowEquations{0.7, 1.3, inertia});
    flow->forcing.plates = {{0.2, -0.3, 0}, {0.5, 0.1, 0}};
    if (inertia != Inertia::none) set_noise_velocity(*flow, 5, 1);
    return flow;
  }

  void spread(ForcedFlow &flow, const std::vector<Real3> &forces) const
  {
    flow.clear_force();
    ASSERT_EQ(flow.spread(points.markers(kernel), numbers(forces), 1), -1);
    flow.accumulate_ghosts();
  }

  void solve(ForcedFlow &flow) const
  {
    if (inertia == Inertia::none)
      flow.solve();
    else
      flow.start_step(0.2);
    flow.fill_ghosts();
  }

  std::vector<Real3> apply_mobility(ForcedFlow &flow, const std::vector<Real3> &forces) const
  {
    std::vector<Real3> velocity(points.count(), {0, 0, 0});
    flow.apply_mobility(points.markers(kernel), numbers(forces), numbers(velocity));
    return velocity;
  }

  double work(const std::vector<Real3> &force, const std::vector<Real3> &velocity) const
  {
    double work = 0;
    for (int n : points.index)
      for (int d = 0; d < 3; ++d) work += force[n][d] * velocity[n][d];
    return sum(work);
  }

  /// force + factor other
  std::vector<Real3> combined(double factor) const
  {
    std::vector<Real3> sum = points.force;
    for (int n = 0; n < points.count(); ++n)
      for (int d = 0; d < 3; ++d) sum[n][d] += factor * other[n][d];
    return sum;
  }

  Inertia inertia;
  Grid grid;
  Decomposition decomposition;
  Points points;
  std::vector<Real3> other;
};

constexpr double factor = -0.6;

TEST(Response, IsLinearAndSymmetric)
{
  for (const Case &which : cases()) {
    SCOPED_TRACE(describe(which));
    const Scene scene(which);
    const auto flow = scene.flow();
    scene.solve(*flow);
    const auto first = scene.apply_mobility(*flow, scene.points.force),
               second = scene.apply_mobility(*flow, scene.other),
               both = scene.apply_mobility(*flow, scene.combined(factor));
    const double scale =
        std::sqrt(scene.work(scene.points.force, first) * scene.work(scene.other, second));
    EXPECT_GT(scale, 0);
    EXPECT_NEAR(scene.work(scene.other, first), scene.work(scene.points.force, second),
                1e-13 * scale);
    Error linearity;
    for (int n : scene.points.index)
      for (int d = 0; d < 3; ++d) linearity.add(both[n][d] - first[n][d] - factor * second[n][d]);
    EXPECT_LT(linearity.over_ranks().largest, 1e-13);
  }
}

/// In the middle of a step and, with inertia, at its end; in damped steps and others.
TEST(Response, AddedIsTheFlowOfTheSumOfForces)
{
  for (const Case &which : cases()) {
    const Scene scene(which);
    const auto at_once = scene.flow(), in_two = scene.flow();
    const Box &brick = at_once->brick();
    for (int n = 0; n < (which.inertia == Inertia::none ? 1 : 4); ++n) {
      SCOPED_TRACE(describe(which) + ", step " + std::to_string(n));
      const auto compare = [&] {
        EXPECT_LT(difference(at_once->velocity(), in_two->velocity(), brick).largest, 1e-13);
        EXPECT_LT(difference(at_once->pressure(), in_two->pressure(), brick).largest, 1e-12);
        EXPECT_LT(difference(at_once->force(), in_two->force(), brick).largest, 1e-13);
      };
      scene.spread(*at_once, scene.combined(factor));
      scene.solve(*at_once);
      scene.spread(*in_two, scene.points.force);
      scene.solve(*in_two);
      scene.apply_mobility(*in_two, scene.other);
      in_two->add_mobility_flow(factor);
      compare();

      std::vector<Real3> one(scene.points.count()), other = one;
      at_once->interpolate(scene.points.markers(kernel), numbers(one));
      in_two->interpolate(scene.points.markers(kernel), numbers(other));
      Error at_markers;
      for (int n : scene.points.index)
        for (int d = 0; d < 3; ++d) at_markers.add(one[n][d] - other[n][d]);
      EXPECT_LT(at_markers.over_ranks().largest, 1e-13);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(at_once->lower_direct()[c], in_two->lower_direct()[c], 1e-12);
        EXPECT_NEAR(at_once->upper_direct()[c], in_two->upper_direct()[c], 1e-12);
      }
      if (which.inertia == Inertia::none) continue;
      at_once->finish_step();
      in_two->finish_step();
      compare();
    }
  }
}

}    // namespace
