#include "vessel/periodic_lids.h"

#include "test_support.h"

using rbc::PackingBox;
using test::Triangle;
using test::Vec3;

namespace {

constexpr int sides = 12;
const PackingBox box{Vec3(-2, -6, -5), Vec3(7, 11, 10), {true, false, true}};

/// A fan across one end of a prism.
std::vector<Triangle> lid(double x, double y)
{
  std::vector<Triangle> triangles;
  for (const Triangle &side : test::prism(sides, 2, x, 1, 1, y, 0))
    if (side[0][0] == x && side[1][0] == x) triangles.push_back({Vec3(x, y, 0), side[0], side[1]});
  return triangles;
}

std::vector<Triangle> joined(std::vector<Triangle> a, const std::vector<Triangle> &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(PeriodicLids, CountTrianglesOnPeriodicFaces)
{
  const std::vector<Triangle> tube = test::prism(sides, 2, -2, 7, 3, 0.3, 0);
  for (const rbc::Lids &none : rbc::find_lids(tube, box)) {
    EXPECT_EQ(none.triangles[0] + none.triangles[1], 0);
    EXPECT_FALSE(none.facing);
  }
  const auto both = rbc::find_lids(joined(tube, joined(lid(-2, 0.3), lid(5, 0.3))), box);
  EXPECT_EQ(both[0].triangles[0], sides);
  EXPECT_EQ(both[0].triangles[1], sides);
  EXPECT_TRUE(both[0].facing);
  EXPECT_FALSE(both[1].facing || both[2].facing);

  const auto one =
      rbc::find_lids(joined(tube, lid(5 - 1e-6, 0.3)), box);    // as numbers are printed
  EXPECT_EQ(one[0].triangles[0], 0);
  EXPECT_EQ(one[0].triangles[1], sides);
  EXPECT_FALSE(one[0].facing);

  PackingBox closed = box;
  closed.periodic[0] = false;
  EXPECT_EQ(rbc::find_lids(joined(tube, lid(-2, 0.3)), closed)[0].triangles[0], 0);
}

TEST(PeriodicLids, FaceEachOtherWhereTheyOverlap)
{
  EXPECT_FALSE(rbc::find_lids(joined(lid(-2, -3), lid(5, 3)), box)[0].facing);
  EXPECT_TRUE(rbc::find_lids(joined(lid(-2, -1), lid(5, 1)), box)[0].facing);
}

TEST(PeriodicLids, OfNoAreaAreNone)
{
  const Vec3 a(-2, 0, 0), b(-2, 1, 0), c(-2, 2, 0);
  EXPECT_EQ(rbc::find_lids({{a, b, c}, {a, b, b}}, box)[0].triangles[0], 0);
}

}    // namespace
