// Distances between cells in a box against all pairs and all images.

#include "cell_packing.h"
#include "test_support.h"

using namespace test;
using rbc::CellPacking;

namespace {

struct Box {
  Vec3 lo, length;
  std::array<bool, 3> periodic;
};

double nearest_image(const Box &box, const Vec3 &a, const Vec3 &b)
{
  Vec3 nearest = (a - b).cwiseAbs();
  for (int d = 0; d < 3; ++d)
    for (int image = -3; box.periodic[d] && image <= 3; ++image)
      nearest[d] = std::min(nearest[d], std::abs(a[d] - b[d] + image * box.length[d]));
  return nearest.norm();
}

bool really_fits(const Box &box, const Vertices &placed, const Vertices &vertices, double gap)
{
  for (const Vec3 &x : vertices) {
    for (int d = 0; d < 3; ++d)
      if (!box.periodic[d] &&
          std::min(x[d] - box.lo[d], box.lo[d] + box.length[d] - x[d]) < gap / 2)
        return false;
    for (const Vec3 &other : placed)
      if (nearest_image(box, x, other) < gap) return false;
  }
  return true;
}

/// Vertices in the box and, where it is periodic, up to a box length outside.
Vec3 anywhere(const Box &box, Random &random)
{
  Vec3 x;
  for (int d = 0; d < 3; ++d) {
    const double beyond = box.periodic[d] ? 1 : 0;
    x[d] = box.lo[d] + random.between(-beyond, 1 + beyond) * box.length[d];
  }
  return x;
}

TEST(Packing, AgreesWithAllPairsOfAllImages)
{
  const Box boxes[] = {{{0, 0, 0}, {1, 1, 1}, {true, true, true}},
                       {{-2, 5, 0.3}, {1, 0.7, 2.1}, {true, true, true}},
                       {{-2, 5, 0.3}, {1, 0.7, 2.1}, {true, false, true}},
                       {{3, -1, -1}, {1.3, 1, 0.9}, {false, false, false}}};
  Random random(12);
  for (const Box &box : boxes)
    // From 16 bins down to one, by two and three, half a length and more than a length.
    for (double gap : {0.06, 0.2, 0.24, 0.33, 0.4, 0.499999, 0.5, 0.500001, 0.6, 0.8, 1.1}) {
      SCOPED_TRACE("gap " + std::to_string(gap));
      const int count = std::max(1, static_cast<int>(0.2 * box.length.prod() / std::pow(gap, 3)));
      int fitted = 0, refused = 0;
      for (int repeat = 0; repeat < 30; ++repeat) {
        CellPacking packing(box.lo, box.length, box.periodic, gap);
        Vertices placed;
        for (int n = 0; n < count; ++n) {
          placed.push_back(anywhere(box, random));
          packing.add({placed.back()});
        }
        for (int n = 0; n < 20; ++n) {
          const Vertices vertices(1, anywhere(box, random));
          const bool fits = really_fits(box, placed, vertices, gap);
          ASSERT_EQ(packing.fits(vertices), fits);
          ++(fits ? fitted : refused);
        }
      }
      EXPECT_GT(refused, 0);
      if (gap < 0.3) {
        EXPECT_GT(fitted, 0);
      }
    }
}

TEST(Packing, TellsAGapFromALittleLess)
{
  const double gap = 0.25, little = 1e-9;
  const Box box{{-1, -1, -1}, {3, 3, 3}, {true, true, true}};
  Random random(20);
  for (int n = 0; n < 500; ++n) {
    CellPacking packing(box.lo, box.length, box.periodic, gap);
    const Vec3 x = anywhere(box, random), direction = random.direction();
    packing.add({x});
    EXPECT_FALSE(packing.fits({x + (gap - little) * direction}));
    EXPECT_TRUE(packing.fits({x + (gap + little) * direction}));
  }
}

TEST(Packing, KeepsHalfAGapFromSides)
{
  const double gap = 0.25, little = 1e-9;
  for (int d = 0; d < 3; ++d) {
    Box box{{-1, -1, -1}, {3, 3, 3}, {true, true, true}};
    box.periodic[d] = false;
    const CellPacking packing(box.lo, box.length, box.periodic, gap);
    Vec3 x(0.4, 0.5, 0.6);
    for (double side : {-1.0, 2.0}) {
      const double inward = side < 0 ? 1 : -1;
      x[d] = side + inward * (gap / 2 + little);
      EXPECT_TRUE(packing.fits({x}));
      x[d] = side + inward * (gap / 2 - little);
      EXPECT_FALSE(packing.fits({x}));
      x[d] = side - inward * 0.1;
      EXPECT_FALSE(packing.fits({x}));
    }
  }
}

TEST(Packing, OneVertexInTheWayIsEnough)
{
  CellPacking packing({0, 0, 0}, {10, 10, 10}, {true, true, true}, 1);
  packing.add({{1, 1, 1}, {5, 5, 5}});
  EXPECT_TRUE(packing.fits({{3, 3, 3}, {7, 7, 7}, {3, 3, 3.1}}));
  EXPECT_FALSE(packing.fits({{3, 3, 3}, {7, 7, 7}, {5, 5.5, 5}}));
  packing.add({{9.9, 3, 3}});
  EXPECT_FALSE(packing.fits({{0.2, 3, 3}}));
}

}    // namespace
