// The angle without branches against that of the C library.

#include "geometry/arc_tangent.h"

#include "test_support.h"

#include <limits>

using namespace test;

namespace {

void expect_as_library(double y, double x)
{
  const double exact = std::atan2(y, x);
  EXPECT_NEAR(rbc::arc_tangent(y, x), exact, 4e-16 * std::abs(exact)) << y << ", " << x;
}

TEST(ArcTangent, IsThatOfTheLibrary)
{
  Random random(1);
  for (int n = 0; n < 200000; ++n) {
    const double angle = random.between(-pi, pi), size = std::exp(random.between(-50, 50));
    expect_as_library(size * std::sin(angle), size * std::cos(angle));
  }
  for (double small = 1; small > 1e-300; small /= 7)
    for (double x : {1.0, -1.0}) {
      expect_as_library(small, x);
      expect_as_library(-small, x);
      expect_as_library(x, small);
      expect_as_library(x, -small);
    }
}

TEST(ArcTangent, OfTheAxesAndDiagonals)
{
  for (double y : {0.0, -0.0, 1.0, -1.0})
    for (double x : {1.0, -1.0, 0.0})
      if (x != 0 || y != 0) expect_as_library(y, x);
  EXPECT_TRUE(std::isnan(rbc::arc_tangent(std::numeric_limits<double>::quiet_NaN(), 1)));
  EXPECT_TRUE(std::isnan(rbc::arc_tangent(1, std::numeric_limits<double>::quiet_NaN())));
}

}    // namespace
