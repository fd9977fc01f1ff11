#include "geometry/closest_point.h"

#include "test_support.h"

#include <set>

using test::plain;
using test::Vec3;

namespace {

Vec3 vector(rbc::PlainVector v)
{
  return {v.x, v.y, v.z};
}

TEST(ClosestPoint, AgreesWithPlaneAndEdges)
{
  test::Random random(5);
  std::set<int> regions;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 a = random.vector(-1, 1), b = random.vector(-1, 1), c = random.vector(-1, 1),
               x = random.vector(-2, 2);
    const auto w = rbc::closest_point_weights(plain(x), plain(a), plain(b), plain(c));
    const Vec3 found = vector(rbc::weighted_point(w, plain(a), plain(b), plain(c)));
    const Vec3 expected = test::closest_point(x, a, b, c);
    ASSERT_NEAR((x - found).norm(), (x - expected).norm(), 1e-12);
    const double square = rbc::triangle_distance_square(plain(x), plain(a), plain(b), plain(c));
    ASSERT_NEAR(square, (x - expected).squaredNorm(), 1e-12);
    ASSERT_NEAR(w[0] + w[1] + w[2], 1, 1e-14);
    for (double weight : w) ASSERT_GE(weight, 0);
    regions.insert((w[0] > 0) + 2 * (w[1] > 0) + 4 * (w[2] > 0));
  }
  EXPECT_EQ(regions.size(), 7u);    // face, edges and corners
}

TEST(ClosestPoint, DistanceToTrianglesWithoutArea)
{
  const Vec3 a(1, 2, 3), b(2, 2, 3), x(0, 2, 5);
  const auto square = [&](const Vec3 &p, const Vec3 &q, const Vec3 &r) {
    return rbc::triangle_distance_square(plain(x), plain(p), plain(q), plain(r));
  };
  EXPECT_DOUBLE_EQ(square(a, a, a), 5);
  EXPECT_DOUBLE_EQ(square(a, a, b), 5);
  EXPECT_DOUBLE_EQ(square(b, a, b), 5);
  EXPECT_DOUBLE_EQ(square(a, b, 2 * b - a), 5);
}

TEST(ClosestPoint, IsContinuousAcrossRegions)
{
  // it moves no further than the point does
  test::Random random(6);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 a = random.vector(-1, 1), b = random.vector(-1, 1), c = random.vector(-1, 1),
               x = random.vector(-2, 2), y = x + 1e-3 * random.direction();
    const auto point = [&](const Vec3 &from) {
      const auto w = rbc::closest_point_weights(plain(from), plain(a), plain(b), plain(c));
      return vector(rbc::weighted_point(w, plain(a), plain(b), plain(c)));
    };
    ASSERT_LE((point(x) - point(y)).norm(), 1e-3 * (1 + 1e-9));
  }
}

}    // namespace
