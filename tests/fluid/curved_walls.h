#pragma once

#include "rigid_scene.h"

// Flows along and around curved surfaces of markers that have closed forms.

namespace test {

/// Zick & Homsy, J. Fluid Mech. 115 (1982) 13, Table 2: up to a volume fraction of 0.343.
inline constexpr double zick_homsy[][2]{{0.18610515, 2.008},
                                        {0.2481402, 2.810},
                                        {0.31017525, 4.292},
                                        {0.37221029, 7.442},
                                        {0.43424534, 15.4}};

struct PoiseuilleError {
  double rate, leakage;    ///< relative to the closed form; through the wall, to the rate
};

/// A force density within a tube, or everywhere, drives the flow.
inline PoiseuilleError poiseuille(KernelKind kernel, double radius,
                                  MarkerKind kind = MarkerKind::points, bool everywhere = false)
{
  const Grid grid = around_tube(radius, 2 * radius);
  const double markers = kind == MarkerKind::points ? radius + surface_offset(kernel) : radius;
  Scene scene(grid, even(grid, {1, 1, ranks()}), kernel, {tube(grid, markers, 1.2)}, true, 1e-4,
              kind);
  scene.solve(
      [&](int c, const Real3 &x) {
        return c == 0 && (everywhere || from_axis(grid, x) < radius) ? 1.0 : 0.0;
      },
      at_rest);
  const auto rates = flow_rates(scene, markers);
  const auto [least, most] = std::minmax_element(rates.begin(), rates.end());
  return {*most / (pi * std::pow(radius, 4) / 8) - 1, (*most - *least) / *most};
}

/// Drag 6 pi viscosity a (K1 U - K2 V) of a sphere on the axis of a tube, V the velocity on the
/// axis far away, by the method of reflections with all images (multipoles and Fourier-Bessel
/// integrals, to more digits than given).
struct TubeFactors {
  double share, k1, k2;    ///< share: radius of the sphere over that of the tube
};

inline constexpr TubeFactors tube_factors[]{{0.1, 1.263216, 1.254796},
                                            {0.3, 2.370075, 2.228958},
                                            {0.5, 5.947265, 4.995246},
                                            {0.7, 24.67595, 17.47401}};

struct TubeAndSphere {
  double tube, sphere;    ///< radii
};

/// With markers at radii that should act as those wanted. Periodic along the tube.
inline TubeFactors found_factors(KernelKind kernel, MarkerKind kind, double length,
                                 const TubeAndSphere &wanted, const TubeAndSphere &markers)
{
  const double radius = wanted.tube, a = wanted.sphere;
  const Grid grid = around_tube(radius, length);
  const double middle = 0.5 * grid.cells[1];
  Scene scene(grid, even(grid, {1, 1, ranks()}), kernel,
              {tube(grid, markers.tube, 1.2),
               sphere({0.5 * grid.cells[0] + 0.1, middle, middle}, markers.sphere, 1.2)},
              true, 1e-4, kind);
  // the tube is driven past the sphere at rest; then the sphere moves
  double force[2], speed[2];
  for (int moves : {0, 1}) {
    scene.solve(
        [&](int c, const Real3 &x) {
          return !moves && c == 0 && from_axis(grid, x) < radius ? 1e-3 : 0.0;
        },
        [&](int body) {
          return Real3{double(moves && body == 1), 0, 0};
        },
        moves);
    force[moves] = scene.force(1)[0] / (6 * pi * a);
    speed[moves] = 2 * flow_rates(scene, markers.tube)[0] / (pi * radius * radius);
  }
  const double k2 = -force[0] / speed[0];
  return {a / radius, force[1] + k2 * speed[1], k2};
}

/// Drag over 6 pi viscosity a U of a sphere that moves away from a plane wall, the height of its
/// centre over its radius being `height`: Brenner, Chem. Eng. Sci. 16 (1961) 242.
inline double brenner(double height)
{
  const double alpha = std::acosh(height);
  double sum = 0;
  for (int n = 1; n < 2000; ++n) {
    const double m = n + 0.5;
    if (2 * m * alpha > 600) break;
    const double above = 2 * std::sinh(2 * m * alpha) + 2 * m * std::sinh(2 * alpha);
    const double below =
        4 * std::pow(std::sinh(m * alpha), 2) - std::pow(2 * m * std::sinh(alpha), 2);
    sum += n * (n + 1.0) / ((2 * n - 1.0) * (2 * n + 3.0)) * (above / below - 1);
  }
  return 4.0 / 3 * std::sinh(alpha) * sum;
}

/// The same of a sphere of markers at a gap above the lower plate. The other plate is three
/// diameters away, and its images six.
inline double drag_off_plate(KernelKind kernel, MarkerKind kind, double radius, double gap)
{
  const int wide = fast_size(static_cast<int>(12 * radius));
  const Grid grid{{wide, wide, wide / 2}, {0, 0, 0}, {1, 1, 1}, true};
  const double markers = kind == MarkerKind::points ? radius - surface_offset(kernel) : radius;
  Scene scene(grid, even(grid, {1, 1, ranks()}), kernel,
              {sphere({wide / 2 + 0.1, wide / 2 + 0.2, radius + gap}, markers, 1.2)}, false, 1e-4,
              kind);
  scene.solve(no_force, [](int) { return Real3{0, 0, 1}; });
  return scene.force(0)[2] / (6 * pi * radius);
}

}    // namespace test
