#include "contact/triangle_fans.h"

#include "../geometry/test_support.h"

#include <map>
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
      const int begin = fans.corners.begin[fan], end = fans.corners.begin[fan + 1];
      const std::set<int> corners(fans.corners.number.begin() + begin,
                                  fans.corners.number.begin() + end);
      EXPECT_EQ(corners, of_triangles);
      EXPECT_EQ((end - begin) % rbc::GROUP, 0);
      EXPECT_LT(end - begin, static_cast<int>(corners.size()) + rbc::GROUP);
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

TEST(TriangleFans, OfCopiesAreThoseOfTheSurface)
{
  const test::Mesh mesh = test::icosphere(6);
  const int vertices = static_cast<int>(mesh.vertices.size());
  std::vector<rbc::NearTriangles::Triangle> all;
  for (const auto &t : mesh.triangles) all.push_back({{t[0], t[1], t[2]}, 1});
  rbc::TriangleFans fans;
  fans.find(all, vertices);
  const std::vector<rbc::TriangleFans::Place> places = fans.places(all);

  // two copies, in another order, of which the second lacks a part
  test::Random random(4);
  std::vector<int> order;
  for (int n = 0; n < static_cast<int>(2 * all.size()); ++n)
    if (n < static_cast<int>(all.size()) + 300) order.push_back(n);
  for (std::size_t n = order.size() - 1; n > 0; --n)
    std::swap(order[n], order[static_cast<int>(random.between(0, n + 0.999))]);
  std::vector<rbc::NearTriangles::Triangle> copies;
  std::vector<rbc::TriangleFans::Place> copied;
  std::vector<int> copy_of, fan_of(order.size(), -1);
  for (int n : order) {
    const int t = n % static_cast<int>(all.size()), copy = n / static_cast<int>(all.size());
    auto triangle = all[t];
    for (int &v : triangle.corner) v = 2 * (vertices - 1 - v) + copy;
    copies.push_back(triangle);
    copied.push_back(places[t]);
    copy_of.push_back(copy);
  }
  rbc::TriangleFans joined;
  joined.join(copies, copied, 2 * vertices);
  for (int fan = 0; fan < joined.triangles.count(); ++fan)
    for (int n = joined.triangles.begin[fan]; n < joined.triangles.begin[fan + 1]; ++n)
      fan_of[joined.triangles.number[n]] = fan;
  EXPECT_EQ(joined.triangles.number.size(), order.size());
  std::map<std::pair<int, int>, int> first;    // by copy and fan of the surface
  std::map<int, std::pair<int, int>> back;
  for (std::size_t n = 0; n < order.size(); ++n) {
    ASSERT_GE(fan_of[n], 0);
    const std::pair<int, int> here{copy_of[n], int(copied[n].fan)};
    EXPECT_EQ(back.insert({fan_of[n], here}).first->second, here);
    if (copy_of[n] == 0) {
      EXPECT_EQ(first.insert({here, fan_of[n]}).first->second, fan_of[n]);
    }
  }
  EXPECT_EQ(first.size(), static_cast<std::size_t>(fans.triangles.count()));
}
