// Drag of rigid spheres of markers in steady flow: simple cubic arrays and a sphere between two
// plates. Writes a table.

#include "rigid_sphere.h"

#include <cstdio>

using namespace test;

namespace {

void print(const char *setting, double parameter, const char *kernel, double spacing, double radius,
           double marker_radius, const Drag &drag, double factor, double reference)
{
  if (rank() != 0) return;
  std::printf("%s,%g,%s,%g,%.4f,%.4f,%d,%d,%.5f,%.5f,%.3f\n", setting, parameter, kernel, spacing,
              radius, marker_radius, drag.markers, drag.solves, factor, reference,
              100 * (factor / reference - 1));
  std::fflush(stdout);
}

/// Zick & Homsy, J. Fluid Mech. 115 (1982) 13, Table 2.
void array(KernelKind kernel, const char *name, double spacing, int n)
{
  const double table[][3]{{0.027, 0.18610515, 2.008},
                          {0.064, 0.2481402, 2.810},
                          {0.125, 0.31017525, 4.292},
                          {0.216, 0.37221029, 7.442}};
  for (const auto &[fraction, radius_over_period, reference] : table) {
    const double radius = radius_over_period * n, markers = marker_radius(kernel, radius, spacing);
    const Grid grid{{n, n, n}, {0, 0, 0}, {1, 1, 1}, false};
    const Drag result =
        drag(grid, kernel, sphere({n / 2 + 0.1, n / 2 + 0.2, n / 2 + 0.3}, markers, spacing));
    print("array", fraction, name, spacing, radius, markers, result,
          result.force / (6 * pi * radius), reference);
  }
}

/// Faxen's series (Happel & Brenner, section 7-4) for a sphere that moves along two plates, at the
/// middle between them or at a quarter. The images in a periodic box of side L change the drag by a
/// part of order (H/L)^2.
void plates(KernelKind kernel, const char *name, double spacing, double radius, double x,
            bool middle)
{
  const double reference =
      middle
          ? 1 / (1 - 1.004 * x + 0.418 * x * x * x + 0.21 * x * x * x * x - 0.169 * std::pow(x, 5))
          : 1 / (1 - 0.6526 * x + 0.1475 * x * x * x - 0.131 * x * x * x * x -
                 0.0644 * std::pow(x, 5));
  const int height = static_cast<int>(std::lround((middle ? 2 : 4) * radius / x));
  const double gap = height / (middle ? 2.0 : 4.0), exact_radius = x * gap;
  const double markers = marker_radius(kernel, exact_radius, spacing);
  double factor[2];
  Drag result{};
  for (int box : {0, 1}) {
    const int n = fast_size((middle ? 3 : 2) * height << box);
    const Grid grid{{n, n, height}, {0, 0, 0}, {1, 1, 1}, true};
    result = drag(grid, kernel, sphere({n / 2 + 0.1, n / 2 + 0.2, gap}, markers, spacing));
    factor[box] = result.force / (6 * pi * exact_radius);
  }
  print(middle ? "plates middle" : "plates quarter", x, name, spacing, exact_radius, markers,
        result, factor[1] + (factor[1] - factor[0]) / 3, reference);
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (rank() == 0)
    std::puts(
        "setting,parameter,kernel,marker_spacing,radius_over_dx,marker_radius_over_dx,markers,"
        "solves,drag_factor,reference,error_percent");
  constexpr double spacing = 1.5;
  const std::pair<KernelKind, const char *> kernels[]{{KernelKind::peskin4, "peskin4"},
                                                      {KernelKind::roma3, "roma3"}};
  for (const auto &[kernel, name] : kernels)
    for (int n : {16, 24, 32, 48}) array(kernel, name, spacing, n);
  for (const auto &[kernel, name] : kernels)
    for (double x : {0.2, 0.3, 0.5}) {
      for (double radius : {3.0, 4.0, 6.0}) plates(kernel, name, spacing, radius, x, true);
      for (double radius : {3.0, 4.0}) plates(kernel, name, spacing, radius, x, false);
    }
  MPI_Finalize();
}
