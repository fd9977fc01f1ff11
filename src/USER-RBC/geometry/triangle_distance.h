#pragma once

#include "geometry/closest_point.h"
#include "geometry/surface_template.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rbc {

using Triangle = std::array<Vec3, 3>;

/// Weights of the corners at the point of a triangle that is closest to p.
inline std::array<double, 3> closest_on_triangle(const Vec3 &p, const Triangle &triangle)
{
  const auto plain = [](const Vec3 &v) { return PlainVector{v[0], v[1], v[2]}; };
  return closest_point_weights(plain(p), plain(triangle[0]), plain(triangle[1]),
                               plain(triangle[2]));
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
