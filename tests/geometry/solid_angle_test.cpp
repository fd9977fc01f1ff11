// Solid angles against closed forms: octants, and closed surfaces seen from inside and outside.

#include "geometry/solid_angle.h"

#include "test_support.h"

#include <algorithm>

using test::Vec3;

namespace {

TEST(SolidAngle, OfAnOctantIsAnEighthOfTheSphere)
{
  for (double size : {1e-3, 1.0, 1e3}) {
    const Vec3 x(size, 0, 0), y(0, 2 * size, 0), z(0, 0, 3 * size);
    EXPECT_NEAR(rbc::solid_angle(x, y, z), M_PI / 2, 1e-14);
    EXPECT_NEAR(rbc::solid_angle(x, z, y), -M_PI / 2, 1e-14);
  }
}

TEST(SolidAngle, OfATetrahedronIsTheSphereFromInsideAndNothingFromOutside)
{
  const Vec3 corners[] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  test::Random random(3);
  for (const auto &[i, j, k] : faces)
    EXPECT_NEAR(rbc::solid_angle(corners[i], corners[j], corners[k]), M_PI, 1e-14);
  for (int n = 0; n < 1000; ++n) {
    // inside are the points whose weights of the corners are all positive
    const Vec3 x = random.vector(-1, 1);
    const double weights[] = {1 + x[0] + x[1] + x[2], 1 - x[0] - x[1] + x[2],
                              1 - x[0] + x[1] - x[2], 1 + x[0] - x[1] - x[2]};
    const bool inside = *std::min_element(weights, weights + 4) > 0;
    double sum = 0;
    for (const auto &[i, j, k] : faces)
      sum += rbc::solid_angle(corners[i] - x, corners[j] - x, corners[k] - x);
    EXPECT_NEAR(sum, inside ? 4 * M_PI : 0, 1e-10);
  }
}

}    // namespace
