// Plates that the fluid slips along: closed forms, and the flow as half of that in a box twice as
// high.

#include "flow_support.h"

using namespace test;

namespace {

constexpr PlateCondition no_slip = PlateCondition::no_slip, free_slip = PlateCondition::free_slip;
const PlateConditions slipping[]{
    {free_slip, no_slip}, {no_slip, free_slip}, {free_slip, free_slip}};

/// Whether all is the same on both sides of a plane: the upper plate, or else the lower one.
struct Mirror {
  bool upper;

  /// The box and its mirror image. Where both plates slip the two of them are one period.
  Grid doubled(const Grid &half) const
  {
    Grid whole = half;
    whole.cells[2] *= 2;
    if (!upper) whole.origin[2] -= half.cells[2] * half.spacing[2];
    const PlateConditions &conditions = half.plate_conditions;
    whole.plates = conditions.lower != conditions.upper;
    whole.plate_conditions = {};
    return whole;
  }

  /// The markers, then their images.
  Points doubled(const Grid &half, const Points &points) const
  {
    Points both = points;
    const double plane = half.origin[2] + (upper ? half.cells[2] * half.spacing[2] : 0);
    for (int n = 0; n < points.count(); ++n) {
      Real3 x = points.position[n], f = points.force[n];
      x[2] = 2 * plane - x[2];
      f[2] = -f[2];
      both.position.push_back(x);
      both.force.push_back(f);
    }
    both.index.clear();
    for (int n = 0; n < both.count(); ++n) both.index.push_back(n);
    return both;
  }
};

/// Velocities that markers take in the last of some steps, and what they would from further forces.
struct Outcome {
  std::vector<Real3> velocity, mobility;
  FlowDiagnostics diagnostics;
};

Outcome follow(const Grid &grid, const Decomposition &decomposition, const FlowEquations &equations,
               const Forcing &forcing, const Points &points, const MarkerSet &markers)
{
  ForcedFlow flow(grid, decomposition, 5, equations);
  flow.forcing = forcing;
  Outcome outcome;
  outcome.velocity.assign(points.count(), {0, 0, 0});
  outcome.mobility = outcome.velocity;
  for (int step = 0; step < (equations.inertia == Inertia::none ? 1 : 4); ++step) {
    flow.clear_force();
    EXPECT_EQ(flow.spread(markers, points.f(), 1), -1);
    flow.accumulate_ghosts();
    if (equations.inertia == Inertia::none)
      flow.solve();
    else
      flow.start_step(0.3);
    flow.fill_ghosts();
    flow.interpolate(markers, numbers(outcome.velocity));
    if (equations.scheme == Scheme::coupled) {
      EXPECT_EQ(flow.apply_mobility(markers, points.f(), numbers(outcome.mobility)), -1);
    }
    if (equations.inertia != Inertia::none) flow.finish_step();
  }
  outcome.diagnostics = flow.diagnose();
  return outcome;
}

void expect_half_of_the_doubled_box(const PlateConditions &conditions,
                                    const FlowEquations &equations, KernelKind kernel,
                                    MarkerKind kind)
{
  const Grid half{{10, 8, 6}, {0.3, -5, 2}, {0.5, 0.4, 0.3}, true, conditions};
  const Mirror mirror{conditions.upper == free_slip};
  Forcing forcing, symmetric;
  forcing.plates = {{0.4, -0.2, 0}, {0.4, -0.2, 0}};
  forcing.body = {0.5, 0.2, 0};
  symmetric = forcing;
  // What a plate's velocity is must not matter where it slips.
  (mirror.upper ? forcing.plates.upper : forcing.plates.lower) = {7, 9, 0};

  Points points = scatter(half, 40, 21);
  const Points both = mirror.doubled(half, points);
  const Decomposition parts = even(half, {1, 1, ranks()});
  assign(points, half, parts);
  const Outcome found =
      follow(half, parts, equations, forcing, points, points.markers(kernel, kind));
  const Grid whole = mirror.doubled(half);
  const Outcome expected =
      follow(whole, alone(whole), equations, symmetric, both, both.markers(kernel, kind));

  Error error, speed;
  for (int n : points.index)
    for (int d = 0; d < 3; ++d) {
      speed.add(expected.velocity[n][d]);
      error.add(found.velocity[n][d] - expected.velocity[n][d]);
      error.add(found.mobility[n][d] - expected.mobility[n][d]);
    }
  EXPECT_LT(error.over_ranks().largest, 1e-12 * speed.over_ranks().largest);

  const FlowDiagnostics &one = found.diagnostics, &two = expected.diagnostics;
  EXPECT_LT(one.max_divergence, 1e-13);
  EXPECT_NEAR(2 * one.kinetic_energy_per_density, two.kinetic_energy_per_density,
              1e-12 * two.kinetic_energy_per_density);
  const auto compare = [](PlateCondition condition, const Real3 &one, const Real3 &two) {
    if (condition == free_slip) {
      EXPECT_EQ(one[0], 0);
      EXPECT_EQ(one[1], 0);
      return;
    }
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(one[d], two[d], 1e-11 * (std::abs(two[d]) + 1));
  };
  compare(conditions.lower, one.lower_traction, two.lower_traction);
  compare(conditions.upper, one.upper_traction, two.upper_traction);
}

TEST(FreeSlip, IsAPlaneOfSymmetry)
{
  for (const PlateConditions &conditions : slipping)
    for (Inertia inertia : {Inertia::none, Inertia::unsteady, Inertia::convective})
      for (Scheme scheme : {Scheme::coupled, Scheme::projection}) {
        const bool both = conditions.lower == conditions.upper;
        if (inertia == Inertia::none && (scheme == Scheme::projection || both)) continue;
        if (both && scheme == Scheme::projection) continue;    // A period is not split.
        const FlowEquations equations{0.7, 1.3, inertia, scheme, false};
        for (MarkerKind kind : {MarkerKind::points, MarkerKind::sheets}) {
          SCOPED_TRACE(std::to_string(int(conditions.lower)) +
                       std::to_string(int(conditions.upper)) + " inertia " +
                       std::to_string(int(inertia)) + " scheme " + std::to_string(int(scheme)) +
                       " kind " + std::to_string(int(kind)));
          expect_half_of_the_doubled_box(conditions, equations, KernelKind::peskin4, kind);
          expect_half_of_the_doubled_box(conditions, equations, KernelKind::roma3, kind);
        }
      }
}

/// Without a plate that holds the fluid its mean velocity follows from forces alone.
TEST(FreeSlip, OfBothPlatesLetsForcesAccelerateTheFluid)
{
  for (Scheme scheme : {Scheme::coupled, Scheme::projection}) {
    const Grid grid{{6, 4, 8}, {0, 0, 0}, {1, 1, 0.1}, true, {free_slip, free_slip}};
    const FlowEquations equations{0.7, 1.3, Inertia::unsteady, scheme};
    ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 0, equations);
    flow.forcing.body = {0.5, -0.2, 0};
    for (int n = 0; n < 5; ++n) step(flow, 0.2);
    Error error;
    for (int c = 0; c < 3; ++c)
      for_each(flow.brick(), [&](int i, int j, int k) {
        error.add(flow.velocity()[c](i, j, k) - flow.forcing.body[c] / 1.3);
      });
    EXPECT_LT(error.over_ranks().largest, 1e-13);
  }
}

/// The parabola whose top is on the plate that slips, plus h^2/4 as between plates without slip.
TEST(FreeSlip, OfOnePlateGivesHalfAParabola)
{
  for (int n : {4, 17, 128})
    for (const PlateConditions &conditions : {slipping[0], slipping[1]}) {
      const double height = 0.8, viscosity = 1.7, h = height / n;
      const Grid grid{{6, 4, n}, {0, 0, 0}, {0.3, 0.2, h}, true, conditions};
      ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 0, FlowEquations{viscosity});
      const Real3 held{0.3, -0.1, 0}, other{5, 6, 0};
      const bool upper = conditions.upper == free_slip;
      flow.forcing.plates = {upper ? held : other, upper ? other : held};
      flow.forcing.body = {0.6, -0.4, 0};
      flow.solve();
      Error error;
      for (int c = 0; c < 3; ++c)
        for_each(flow.brick(), [&](int i, int j, int k) {
          const double z = location(grid, c, i, j, k)[2], from_top = upper ? height - z : z;
          const double parabola = height * height - from_top * from_top + h * h / 4;
          error.add(flow.velocity()[c](i, j, k) - held[c] -
                    flow.forcing.body[c] / (2 * viscosity) * parabola);
        });
      EXPECT_LT(error.over_ranks().largest, 1e-13);
      const FlowDiagnostics found = flow.diagnose();
      const Real3 &drag = upper ? found.lower_traction : found.upper_traction;
      const Real3 &none = upper ? found.upper_traction : found.lower_traction;
      for (int c = 0; c < 2; ++c) {
        EXPECT_NEAR(drag[c], flow.forcing.body[c] * height, 1e-12);
        EXPECT_EQ(none[c], 0);
      }
    }
}

}    // namespace
