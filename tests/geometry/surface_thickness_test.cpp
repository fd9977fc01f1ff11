// Thickness of closed surfaces: of spheres, ellipsoids and a biconcave disc.

#include "geometry/surface_thickness.h"
#include "test_support.h"

using namespace test;

namespace {

double thickness(int frequency, const std::function<Vec3(const Vec3 &)> &map)
{
  Mesh mesh = icosphere(frequency);
  mesh.vertices = transformed(mesh.vertices, map);
  return rbc::surface_thickness(mesh.surface());
}

TEST(SurfaceThickness, OfASphereIsItsDiameter)
{
  // chords end on facets, which lie inside the sphere by up to an eighth of an edge squared
  const double edge = 1.2 / 8;
  const double found = thickness(8, [](const Vec3 &x) -> Vec3 { return 3 * x; });
  EXPECT_LE(found, 6);
  EXPECT_GT(found, 6 * (1 - edge * edge / 4));
}

TEST(SurfaceThickness, OfAnEllipsoidIsItsShortestAxis)
{
  const double found = thickness(12, [](const Vec3 &x) -> Vec3 {
    return {1.3 * x[0], 1.2 * x[1], x[2]};
  });
  EXPECT_NEAR(found, 2, 0.01);
}

TEST(SurfaceThickness, OfABiconcaveDiscIsThatOfItsDimple)
{
  EXPECT_NEAR(rbc::surface_thickness(disc(16).surface()), Profile().a0, 0.01);
}

TEST(SurfaceThickness, HasTheUnitsOfALengthWhateverThePlace)
{
  const auto map = [](double factor, const Vec3 &by) {
    return [=](const Vec3 &x) -> Vec3 { return factor * Vec3(x[0], x[1], 0.5 * x[2]) + by; };
  };
  const double one = thickness(6, map(1, Vec3::Zero()));
  EXPECT_NEAR(thickness(6, map(1e-6, Vec3(5e-6, 2e-6, 1e-6))), 1e-6 * one, 1e-17);
}

}    // namespace
