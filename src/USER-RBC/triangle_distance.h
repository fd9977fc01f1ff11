#pragma once

#include "surface_template.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rbc {

using Triangle = std::array<Vec3, 3>;

/// Weights of the corners at the point of a triangle that is closest to p. Exactly 0 on edges and corners.
inline std::array<double, 3> closest_on_triangle(const Vec3 &p, const Triangle &triangle)
{
  // Ericson, Real-Time Collision Detection (2005), 5.1.5: by Voronoi regions of corners, edges, face
  const auto &[a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double beside_ab = d1 * d4 - d3 * d2;
  if (beside_ab <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double beside_ac = d5 * d2 - d1 * d6;
  if (beside_ac <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const double beside_bc = d3 * d6 - d5 * d4;
  if (beside_bc <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - t, t};
  }
  const double sum = beside_ab + beside_ac + beside_bc;
  return {beside_bc / sum, beside_ac / sum, beside_ab / sum};
}

inline double squared_distance(const Vec3 &p, const Triangle &triangle)
{
  const auto w = closest_on_triangle(p, triangle);
  return (w[0] * triangle[0] + w[1] * triangle[1] + w[2] * triangle[2] - p).squaredNorm();
}

/// Of the segments from a to b and from c to d.
inline double squared_distance(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
{
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.dot(u), vv = v.dot(v), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 0 ? std::clamp((uv * vw - uw * vv) / determinant, 0.0, 1.0) : 0.0;
  double t = (uv * s + vw) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  }
  return (w + s * u - t * v).squaredNorm();
}

/// The segment from p to q passes through the triangle.
inline bool crosses(const Vec3 &p, const Vec3 &q, const Triangle &triangle)
{
  const auto &[a, b, c] = triangle;
  const Vec3 normal = (b - a).cross(c - a);
  const double above = normal.dot(p - a), below = normal.dot(q - a);
  if (above * below > 0 || above == below) return false;
  const Vec3 x = p + above / (above - below) * (q - p);
  return normal.dot((b - a).cross(x - a)) >= 0 && normal.dot((c - b).cross(x - b)) >= 0 &&
         normal.dot((a - c).cross(x - c)) >= 0;
}

/// 0 if they touch or intersect.
inline double distance(const Triangle &first, const Triangle &second)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = first[i], &q = first[(i + 1) % 3];
    if (crosses(p, q, second) || crosses(second[i], second[(i + 1) % 3], first)) return 0;
    least = std::min({least, squared_distance(p, second), squared_distance(second[i], first)});
    for (int j = 0; j < 3; ++j)
      least = std::min(least, squared_distance(p, q, second[j], second[(j + 1) % 3]));
  }
  return std::sqrt(least);
}

}    // namespace rbc
