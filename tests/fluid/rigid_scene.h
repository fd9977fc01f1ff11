#pragma once

#include "fluid/diagnostics.h"
#include "fluid/kernel.h"
#include "rigid_sphere.h"
#include "rigid_tube.h"

namespace test {

inline constexpr int ghost_layers = 4;
inline constexpr double tight = 1e-8;

/// A flow of unit viscosity with markers of rigid bodies.
struct Scene {
  ForcedFlow flow;
  std::vector<Points> bodies;
  std::vector<double> position;
  RigidSurface surface;
  std::vector<int> body;
  KernelKind kernel;

  Scene(const Grid &grid, const Decomposition &decomposition, KernelKind kernel,
        std::vector<Points> bodies, bool free_mean, double tolerance = tight,
        MarkerKind kind = MarkerKind::points) :
      flow(grid, decomposition, layers(kind), FlowEquations{}),
      bodies(std::move(bodies)), kernel(kernel)
  {
    RigidSurface::Settings settings;
    settings.free_mean = free_mean;
    settings.tolerance = tolerance;
    settings.max_solves = 300;
    settings.kind = kind;
    if (tolerance < 1e-6) settings.most_directions = 300;
    surface.set_settings(settings);
    for (std::size_t b = 0; b < this->bodies.size(); ++b) {
      assign(this->bodies[b], grid, decomposition);
      const auto rows = rows_here(this->bodies[b].position, this->bodies[b]);
      position.insert(position.end(), rows.begin(), rows.end());
      body.insert(body.end(), this->bodies[b].index.size(), static_cast<int>(b));
    }
    surface.set_markers(flow, kernel, static_cast<int>(body.size()), position.data(), body.data());
  }

  static int layers(MarkerKind kind)
  {
    return ghost_layers + (kind == MarkerKind::sheets ? SheetVelocity::layers : 0);
  }

  /// body_force(c, x) is the force density; velocity(b) is that of a body, or velocity(b, x) that
  /// of a marker of it.
  template <typename Force, typename Velocity>
  RigidSurface::Outcome solve(Force body_force, Velocity velocity, double time = 0)
  {
    const auto outcome = attempt(body_force, velocity, time);
    EXPECT_TRUE(outcome.converged) << outcome.slip;
    return outcome;
  }

  /// The same where it may take more solves than are allowed.
  template <typename Force, typename Velocity>
  RigidSurface::Outcome attempt(Force body_force, Velocity velocity, double time = 0)
  {
    const Grid &grid = flow.grid();
    flow.clear_force();
    Real3 total{0, 0, 0};
    for (int c = 0; c < 3; ++c)
      set(flow.force()[c], flow.brick(), [&](int i, int j, int k) {
        const double f = body_force(c, location(grid, c, i, j, k));
        total[c] += f * grid.cell_volume();
        return f;
      });
    for (std::size_t n = 0; n < body.size(); ++n) {
      const Real3 u = at_marker(velocity, n);
      std::copy_n(u.data(), 3, surface.target() + 3 * n);
    }
    EXPECT_LT(surface.spread(flow, time, total), 0);
    flow.accumulate_ghosts();
    if (surface.settings().free_mean) flow.forcing.mean = surface.mean();
    flow.solve();
    const auto outcome = surface.enforce(flow);
    if (surface.settings().free_mean) flow.forcing.mean = surface.mean();
    return outcome;
  }

  /// On the fluid, by one body.
  Real3 force(int of)
  {
    Real3 sum{0, 0, 0};
    for (std::size_t n = 0; n < body.size(); ++n)
      for (int d = 0; d < 3; ++d)
        if (body[n] == of) sum[d] += surface.force()[3 * n + d];
    reduce(MPI_SUM, sum[0], sum[1], sum[2]);
    return sum;
  }

  /// On the fluid, by one body that is not across a side of the box.
  Real3 torque(int of, const Real3 &about)
  {
    Real3 sum{0, 0, 0};
    for (std::size_t n = 0; n < body.size(); ++n)
      for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        const double *const x = &position[3 * n], *const force = surface.force() + 3 * n;
        if (body[n] == of) sum[d] += (x[e] - about[e]) * force[f] - (x[f] - about[f]) * force[e];
      }
    reduce(MPI_SUM, sum[0], sum[1], sum[2]);
    return sum;
  }

 private:
  template <typename Velocity> Real3 at_marker(const Velocity &velocity, std::size_t n) const
  {
    if constexpr (std::is_invocable_v<Velocity, int, Real3>)
      return velocity(body[n], Real3{position[3 * n], position[3 * n + 1], position[3 * n + 2]});
    else
      return velocity(body[n]);
  }
};

inline constexpr auto no_force = [](int, const Real3 &) { return 0.0; };
inline constexpr auto at_rest = [](int) { return Real3{0, 0, 0}; };

/// Rate of flow along x through the tube, in each plane of faces; radius(x) bounds it.
template <typename Radius> std::vector<double> flow_rates(const Scene &scene, Radius radius)
{
  const Grid &grid = scene.flow.grid();
  std::vector<double> rates(grid.cells[0], 0.0);
  for_each(scene.flow.brick(), [&](int i, int j, int k) {
    const Real3 x = location(grid, 0, i, j, k);
    if (from_axis(grid, x) < radius(x[0]))
      rates[i] += scene.flow.velocity()[0](i, j, k) * grid.spacing[1] * grid.spacing[2];
  });
  MPI_Allreduce(MPI_IN_PLACE, rates.data(), grid.cells[0], MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return rates;
}

inline std::vector<double> flow_rates(const Scene &scene, double radius)
{
  return flow_rates(scene, [radius](double) { return radius; });
}

inline Grid around_tube(double radius, double length)
{
  const int wide = fast_size(static_cast<int>(std::ceil(2 * radius + 8)));
  return {
      {fast_size(static_cast<int>(std::lround(length))), wide, wide}, {0, 0, 0}, {1, 1, 1}, false};
}

/// Drag over 6 pi viscosity a U of a simple cubic array of n^3 cells a sphere, U the mean velocity.
inline double array(KernelKind kernel, double radius, double markers, int n,
                    MarkerKind kind = MarkerKind::points)
{
  const Grid grid{{n, n, n}, {0, 0, 0}, {1, 1, 1}, false};
  Scene scene(grid, even(grid, {1, 1, ranks()}), kernel,
              {sphere({n / 2 + 0.1, n / 2 + 0.2, n / 2 + 0.3}, markers, 1.2)}, false, 1e-4, kind);
  scene.flow.forcing.mean = {1, 0, 0};
  scene.solve(no_force, at_rest);
  return -scene.force(0)[0] / (6 * pi * radius);
}

/// Radius of the markers of a sphere that has, in a dilute array, the drag of the radius wanted.
inline double dilute_radius(KernelKind kernel, double wanted)
{
  const int n = fast_size(static_cast<int>(std::ceil(8 * wanted)));
  double markers = wanted - surface_offset(kernel);
  for (int round = 0; round < 2; ++round) {
    const double drag = array(kernel, 1, markers, n);
    double a = markers;
    for (int iteration = 0; iteration < 50; ++iteration) a = drag / dilute_array(a / n);
    markers += wanted - a;
  }
  return markers;
}

}    // namespace test
