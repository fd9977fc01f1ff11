#include "geometry/surface_thickness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace rbc {

namespace {

constexpr double facing = 0.866;    ///< cosine of 30 degrees

/// Normal of a triangle, as long as twice its area.
Vec3 normal_of(const SurfaceTemplate &surface, int triangle)
{
  const auto &[a, b, c] = surface.triangles[triangle];
  const auto &x = surface.vertices;
  return (x[b] - x[a]).cross(x[c] - x[a]);
}

/// Where a ray from `start` meets a triangle, as a distance (Moeller & Trumbore, J. Graphics Tools
/// 2 (1997) 21); infinite if it does not.
double distance_along(const Vec3 &start, const Vec3 &ray, const Vec3 &a, const Vec3 &b,
                      const Vec3 &c)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const Vec3 ab = b - a, ac = c - a, p = ray.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return none;
  const Vec3 from = start - a, q = from.cross(ab);
  const double u = from.dot(p) / determinant, v = ray.dot(q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return none;
  return ac.dot(q) / determinant;
}

}    // namespace

double surface_thickness(const SurfaceTemplate &surface)
{
  std::vector<Vec3> normals;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    normals.push_back(normal_of(surface, static_cast<int>(t)));
  const auto &x = surface.vertices;
  double thickness = std::numeric_limits<double>::infinity();
  for (int v = 0; v < surface.vertex_count(); ++v) {
    Vec3 inward = Vec3::Zero();
    for (int t : surface.incident_triangles[v]) inward -= normals[t];
    inward.normalize();
    for (std::size_t t = 0; t < normals.size(); ++t) {
      if (inward.dot(normals[t]) < facing * normals[t].norm()) continue;
      const auto &[a, b, c] = surface.triangles[t];
      const double distance = distance_along(x[v], inward, x[a], x[b], x[c]);
      if (distance > 0) thickness = std::min(thickness, distance);
    }
  }
  return std::isfinite(thickness) ? thickness : 0;
}

}    // namespace rbc
