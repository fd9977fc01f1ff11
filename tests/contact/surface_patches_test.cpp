#include "contact/surface_patches.h"

#include "../geometry/test_support.h"

#include <algorithm>
#include <cmath>

namespace {

/// Lengths of the shortest paths between all vertices (Floyd and Warshall).
Eigen::MatrixXd paths(const rbc::SurfaceTemplate &surface)
{
  const int n = surface.vertex_count();
  Eigen::MatrixXd path = Eigen::MatrixXd::Constant(n, n, HUGE_VAL);
  for (int v = 0; v < n; ++v) {
    path(v, v) = 0;
    for (int w : surface.neighbors[v])
      path(v, w) = (surface.vertices[w] - surface.vertices[v]).norm();
  }
  for (int by = 0; by < n; ++by)
    for (int v = 0; v < n; ++v)
      for (int w = 0; w < n; ++w) path(v, w) = std::min(path(v, w), path(v, by) + path(by, w));
  return path;
}

TEST(SurfacePatches, HoldWhatIsNearAlongEdges)
{
  const test::Mesh mesh = test::icosphere(4);
  const rbc::SurfaceTemplate sphere(test::waved(mesh.vertices, 3), mesh.triangles);
  const Eigen::MatrixXd path = paths(sphere);
  for (double distance : {0.3, 0.7, 1.5, 10.0}) {
    const auto patches = rbc::surface_patches(sphere, distance);
    ASSERT_EQ(static_cast<int>(patches.size()), sphere.vertex_count());
    for (int v = 0; v < sphere.vertex_count(); ++v) {
      std::vector<int> expected;
      for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
        const auto &[a, b, c] = sphere.triangles[t];
        if (std::min({path(v, a), path(v, b), path(v, c)}) <= distance)
          expected.push_back(static_cast<int>(t));
      }
      EXPECT_EQ(patches[v], expected);
    }
  }
}

TEST(SurfacePatches, OfNoExtentIsTheFan)
{
  const test::Mesh mesh = test::icosphere(2);
  const rbc::SurfaceTemplate sphere(mesh.vertices, mesh.triangles);
  const auto patches = rbc::surface_patches(sphere, 0);
  for (int v = 0; v < sphere.vertex_count(); ++v) {
    auto incident_corners = sphere.incident_triangles[v];
    std::sort(incident_corners.begin(), incident_corners.end());
    EXPECT_EQ(patches[v], incident_corners);
  }
}

TEST(SurfacePatches, FansSeeEachOtherBeyondThem)
{
  const test::Mesh mesh = test::icosphere(5);
  const rbc::SurfaceTemplate sphere(test::waved(mesh.vertices, 3), mesh.triangles);
  std::vector<rbc::NearTriangles::Triangle> all;
  for (const auto &corners : sphere.triangles) all.push_back({corners, 0});
  rbc::TriangleFans found;
  found.find(all, sphere.vertex_count());
  const auto places = found.places(all);
  const int fans = found.triangles.count();
  for (double distance : {0.3, 1.5, 10.0}) {
    const auto patches = rbc::surface_patches(sphere, distance);
    std::vector<char> expected(fans * fans, 0);
    for (std::size_t t = 0; t < all.size(); ++t)
      for (int v : all[t].corner)
        for (std::size_t u = 0; u < all.size(); ++u)
          if (!std::binary_search(patches[v].begin(), patches[v].end(), static_cast<int>(u)))
            expected[places[t].fan * fans + places[u].fan] =
                expected[places[u].fan * fans + places[t].fan] = 1;
    EXPECT_EQ(rbc::fans_that_see(sphere, patches, places), expected);
    EXPECT_EQ(std::count(expected.begin(), expected.end(), 1) == 0, distance > 9);
  }
}

}    // namespace
