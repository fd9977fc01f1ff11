#include "rigid_sphere.h"

namespace {

using namespace test;

constexpr double marker_spacing = 1.5;

/// Drag factor of a simple cubic array of n^3 cells a sphere.
double array(KernelKind kernel, double radius_over_period, int n)
{
  const double radius = radius_over_period * n;
  const Grid grid{{n, n, n}, {0, 0, 0}, {1, 1, 1}, false};
  const Points points = sphere({n / 2 + 0.1, n / 2 + 0.2, n / 2 + 0.3},
                               marker_radius(kernel, radius, marker_spacing), marker_spacing);
  return drag(grid, kernel, points).force / (6 * pi * radius);
}

/// Zick & Homsy, J. Fluid Mech. 115 (1982) 13, Table 2.
TEST(Drag, OfASimpleCubicArray)
{
  const double table[][2]{
      {0.18610515, 2.008}, {0.2481402, 2.810}, {0.31017525, 4.292}, {0.37221029, 7.442}};
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3})
    for (const auto &[radius, reference] : table) {
      const double coarse = array(kernel, radius, 16) / reference - 1,
                   fine = array(kernel, radius, 30) / reference - 1;
      EXPECT_LT(std::abs(coarse), 0.02) << radius;
      EXPECT_LT(std::abs(fine), 0.007) << radius;
      EXPECT_TRUE(std::abs(fine) < 0.6 * std::abs(coarse) || std::abs(fine) < 5e-4)
          << radius << ": " << coarse << ", " << fine;
    }
}

/// Faxen's series for a sphere midway between two plates (Happel & Brenner, section 7-4).
TEST(Drag, BetweenPlates)
{
  constexpr double radius = 3, x = 0.25;
  const int height = static_cast<int>(2 * radius / x);
  const double reference =
      1 / (1 - 1.004 * x + 0.418 * x * x * x + 0.21 * std::pow(x, 4) - 0.169 * std::pow(x, 5));
  for (KernelKind kernel : {KernelKind::peskin4, KernelKind::roma3}) {
    const double markers = marker_radius(kernel, radius, marker_spacing);
    double factor[2];    // for two sides of the periodic box; images count with its square
    for (int box : {0, 1}) {
      const int n = (2 * height) << box;
      const Grid grid{{n, n, height}, {0, 0, 0}, {1, 1, 1}, true};
      const Points points =
          sphere({n / 2 + 0.1, n / 2 + 0.2, 0.5 * height}, markers, marker_spacing);
      factor[box] = drag(grid, kernel, points).force / (6 * pi * radius);
    }
    EXPECT_NEAR(factor[1] + (factor[1] - factor[0]) / 3, reference, 0.005 * reference);
  }
}

}    // namespace
