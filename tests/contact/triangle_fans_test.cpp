#include "contact/triangle_fans.h"

#include "../geometry/test_support.h"

#include <set>

TEST(TriangleFans, HoldEachTriangleOnce)
{
  const test::Mesh mesh = test::icosphere(6);
  std::vector<rbc::NearTriangles::Triangle> all;
  for (const auto &t : mesh.triangles) all.push_back({{t[0], t[1], t[2]}, 1});
  for (const int known : {static_cast<int>(all.size()), 100, 1}) {    // or a part of the surface
    all.resize(known);
    rbc::TriangleFans fans;
    fans.find(all, static_cast<int>(mesh.vertices.size()));
    std::multiset<int> found;
    double widest = 0;
    for (int fan = 0; fan < fans.triangles.count(); ++fan) {
      std::set<int> of_triangles;
      for (int n = fans.triangles.begin[fan]; n < fans.triangles.begin[fan + 1]; ++n) {
        found.insert(fans.triangles.number[n]);
        for (int v : all[fans.triangles.number[n]].corner) of_triangles.insert(v);
      }
      const std::multiset<int> corners(fans.corners.number.begin() + fans.corners.begin[fan],
                                       fans.corners.number.begin() + fans.corners.begin[fan + 1]);
      EXPECT_EQ(corners, std::multiset<int>(of_triangles.begin(), of_triangles.end()));
      for (int v : corners)
        for (int w : corners)
          widest = std::max(widest, (mesh.vertices[v] - mesh.vertices[w]).norm());
    }
    EXPECT_EQ(found.size(), all.size());
    EXPECT_EQ(std::set<int>(found.begin(), found.end()).size(), all.size());
    EXPECT_LT(widest, 5 * 0.21) << "edges are up to 0.21";
    if (known > 100) {
      EXPECT_LT(fans.triangles.count(), known / 5);
    }
  }
}
