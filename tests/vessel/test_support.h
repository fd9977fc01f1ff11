#pragma once

#include "../geometry/test_support.h"
#include "vessel/triangulated_solid.h"

namespace test {

using rbc::Triangle;

inline const rbc::PackingBox open_space{
    Vec3::Zero(), Vec3::Constant(HUGE_VAL), {false, false, false}};

inline std::vector<Triangle> triangles_of(const Mesh &mesh)
{
  std::vector<Triangle> triangles;
  for (const auto &[a, b, c] : mesh.triangles)
    triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  return triangles;
}

/// A tube along x with the section of a regular polygon: two triangles a side and layer, open at
/// both ends.
inline std::vector<Triangle> prism(int sides, double inradius, double lo, double length, int layers,
                                   double y, double z)
{
  const double radius = inradius / std::cos(pi / sides);
  const auto corner = [&](int layer, int side) {
    const double angle = 2 * pi * side / sides;
    return Vec3(lo + length * layer / layers, y + radius * std::cos(angle),
                z + radius * std::sin(angle));
  };
  std::vector<Triangle> triangles;
  for (int layer = 0; layer < layers; ++layer)
    for (int side = 0; side < sides; ++side) {
      const Vec3 a = corner(layer, side), b = corner(layer, side + 1), c = corner(layer + 1, side),
                 d = corner(layer + 1, side + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({b, d, c});
    }
  return triangles;
}

/// Signed distance of the axis of such a tube from its sides, for points inside.
inline double prism_distance(int sides, double inradius, double y, double z)
{
  double distance = -inradius;
  for (int side = 0; side < sides; ++side) {
    const double angle = 2 * pi * (side + 0.5) / sides;
    distance = std::max(distance, y * std::cos(angle) + z * std::sin(angle) - inradius);
  }
  return distance;
}

}    // namespace test
