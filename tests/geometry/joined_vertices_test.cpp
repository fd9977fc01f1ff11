// Vertices of a surface that a periodic box holds apart.

#include "geometry/joined_vertices.h"
#include "test_support.h"

using namespace test;

namespace {

const Vec3 periods(5, 4.5, 0);    // not periodic in z, and the surface is wider than half of it

rbc::SurfaceTemplate sphere()
{
  Mesh mesh = icosphere(2);
  for (Vec3 &vertex : mesh.vertices) vertex *= 2;
  return mesh.surface();
}

class Joined : public testing::Test {
 protected:
  void SetUp() override
  {
    joined.set_periods(periods);
    for (int v = 0; v < n; ++v)
      for (int d = 0; d < 2; ++d) x[v][d] -= std::floor(x[v][d] / periods[d]) * periods[d];
  }

  const rbc::SurfaceTemplate shape = sphere();
  const int n = shape.vertex_count();
  std::vector<Vec3> x = shape.vertices, shift = std::vector<Vec3>(n, Vec3::Zero());
  std::vector<char> known = std::vector<char>(n, 1), placed = std::vector<char>(n);
  rbc::JoinedVertices joined{shape};
  const rbc::JoinedVertices::Cell cell{x.data(), known.data(), placed.data(), shift.data()};
};

TEST_F(Joined, TheCellIsWholeWhereItsFirstVertexIs)
{
  const Vec3 away(3 * periods[0], -7 * periods[1], 0);
  placed[0] = 1;
  shift[0] = shape.vertices[0] - x[0] + away;
  joined.join(cell);
  for (int v = 0; v < n; ++v) {
    EXPECT_TRUE(placed[v]);
    EXPECT_LT((x[v] + shift[v] - shape.vertices[v] - away).norm(), 1e-13);
  }
  EXPECT_LT(joined.widest(cell).ratio, 1);
  EXPECT_NEAR(joined.most_stretched(cell).ratio, 1, 1e-13);
}

TEST_F(Joined, UnknownVerticesSeparate)
{
  // without a ring of neighbours, and what they have around them, nothing is reached
  placed[0] = 1;
  for (int w : shape.neighbors[0]) known[w] = 0;
  joined.join(cell);
  EXPECT_EQ(std::count(placed.begin(), placed.end(), 1), 1);
}

TEST_F(Joined, AnEdgeOfMoreThanHalfABoxIsSeen)
{
  // a box that became longer without its vertices
  joined.set_periods(periods + Vec3(4, 0, 0));
  placed[0] = 1;
  joined.join(cell);
  EXPECT_GT(joined.most_stretched(cell).ratio, 3);
  joined.set_periods(periods);
  std::fill(placed.begin(), placed.end(), 0);
  placed[0] = 1;
  x[9][0] += periods[0] / 2;
  joined.join(cell);
  EXPECT_GT(joined.widest(cell).ratio, 1);
}

}    // namespace
