#pragma once

#include "fluid/direct_forcing.h"
#include "test_support.h"

namespace test {

/// Rigid sphere of markers, about one to an area of spacing^2, on a spiral of golden angle.
inline Points sphere(const Real3 &centre, double radius, double spacing)
{
  const int count = static_cast<int>(std::lround(4 * pi * radius * radius / (spacing * spacing)));
  const double turn = pi * (3 - std::sqrt(5.0));
  Points points;
  for (int n = 0; n < count; ++n) {
    const double z = 1 - (2 * n + 1.0) / count, across = std::sqrt(1 - z * z);
    points.position.push_back({centre[0] + radius * across * std::cos(turn * n),
                               centre[1] + radius * across * std::sin(turn * n),
                               centre[2] + radius * z});
  }
  return points;
}

struct Drag {
  double force;    ///< on the fluid, along x
  int markers, solves;
};

/// Steady drag of a sphere of markers that moves with unit velocity along x in a fluid of unit
/// viscosity. Collective.
inline Drag drag(const Grid &grid, KernelKind kernel, Points points, double tolerance = 1e-3)
{
  constexpr int ghost_layers = 4;
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), ghost_layers, FlowEquations{});
  assign(points, grid, flow.decomposition());
  const std::size_t numbers = 3 * points.position.size();
  std::vector<double> none(numbers), target(numbers), force(numbers), velocity(numbers);
  for (std::size_t n = 0; n < numbers; n += 3) target[n] = 1;
  DirectForcing direct;
  direct.tolerance = tolerance;
  const auto outcome = direct.advance(flow, 0, {},
                                      {points.markers(kernel), none.data(), nullptr, target.data(),
                                       force.data(), velocity.data(), points.count()});
  double sum = 0;
  for (int n : points.index) sum += force[3 * n];
  return {test::sum(sum), points.count(), outcome.solves};
}

/// Drag over 6 pi viscosity a U of a simple cubic array, U the mean velocity relative to the
/// spheres, for few spheres: Sangani & Acrivos, Int. J. Multiphase Flow 8 (1982) 343.
inline double dilute_array(double radius_over_period)
{
  const double c = 4 * pi / 3 * std::pow(radius_over_period, 3);
  return 1 / (1 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c + 3.9799 * std::pow(c, 8.0 / 3) -
              3.0734 * std::pow(c, 10.0 / 3));
}

/// Radius of the sphere that drags as the markers at `radius` (all in cells) do, far from others:
/// measured in an array of volume fraction 0.008.
inline double hydrodynamic_radius(KernelKind kernel, double radius, double spacing)
{
  const int n = fast_size(static_cast<int>(std::ceil(8 * radius)));
  const Grid grid{{n, n, n}, {0, 0, 0}, {1, 1, 1}, false};
  const double force =
      drag(grid, kernel, sphere({n / 2 + 0.1, n / 2 + 0.2, n / 2 + 0.3}, radius, spacing)).force;
  double a = radius;
  for (int iteration = 0; iteration < 50; ++iteration) a = force / (6 * pi * dilute_array(a / n));
  return a;
}

/// Radius of the markers of a sphere of the hydrodynamic radius wanted.
inline double marker_radius(KernelKind kernel, double wanted, double spacing)
{
  double radius = wanted - 0.5;
  for (int n = 0; n < 2; ++n) radius += wanted - hydrodynamic_radius(kernel, radius, spacing);
  return radius;
}

}    // namespace test
