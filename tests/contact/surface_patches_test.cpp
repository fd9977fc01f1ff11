#include "surface_patches.h"

#include "test_support.h"

namespace {

// Paths along edges are longer than great circles, by up to 2 / sqrt(3) in a plane of equal triangles.
TEST(SurfacePatches, LieBetweenTwoCaps)
{
  const test::Mesh mesh = test::icosphere(8);
  const rbc::SurfaceTemplate sphere(mesh.vertices, mesh.triangles);
  const double distance = 0.7;
  const auto patches = rbc::surface_patches(sphere, distance);
  ASSERT_EQ(patches.size(), mesh.vertices.size());
  for (std::size_t v = 0; v < patches.size(); ++v) {
    EXPECT_TRUE(std::is_sorted(patches[v].begin(), patches[v].end()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      double angle = HUGE_VAL;
      for (int corner : mesh.triangles[t])
        angle =
            std::min(angle, std::acos(std::min(1.0, mesh.vertices[v].dot(mesh.vertices[corner]))));
      const bool inside = std::binary_search(patches[v].begin(), patches[v].end(), int(t));
      EXPECT_TRUE(inside || angle > 0.99 * distance * std::sqrt(3) / 2) << v << " " << t;
      EXPECT_TRUE(!inside || angle < 1.01 * distance) << v << " " << t;
    }
  }
}

TEST(SurfacePatches, OfNoExtentIsTheFan)
{
  const test::Mesh mesh = test::icosphere(2);
  const rbc::SurfaceTemplate sphere(mesh.vertices, mesh.triangles);
  const auto patches = rbc::surface_patches(sphere, 0);
  for (int v = 0; v < sphere.size(); ++v) {
    auto fan = sphere.fans[v];
    std::sort(fan.begin(), fan.end());
    EXPECT_EQ(patches[v], fan);
  }
}

}    // namespace
