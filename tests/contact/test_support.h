#pragma once

#include "../membrane/test_support.h"
#include "plain_vector.h"

namespace test {

inline rbc::PlainVector plain(const Vec3 &v)
{
  return {v[0], v[1], v[2]};
}

/// Point of a triangle closest to x: of its plane if inside, else of the closest edge.
inline Vec3 closest_point(const Vec3 &x, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const Vec3 corner[3] = {a, b, c};
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const Vec3 foot = x - normal.dot(x - a) * normal;
  bool inside = true;
  for (int e = 0; e < 3; ++e) {
    const Vec3 &from = corner[e], &to = corner[(e + 1) % 3];
    inside = inside && (to - from).cross(foot - from).dot(normal) >= 0;
  }
  if (inside) return foot;
  Vec3 best = a;
  for (int e = 0; e < 3; ++e) {
    const Vec3 &from = corner[e], edge = corner[(e + 1) % 3] - from;
    const double along = std::clamp(edge.dot(x - from) / edge.squaredNorm(), 0.0, 1.0);
    const Vec3 point = from + along * edge;
    if ((x - point).norm() < (x - best).norm()) best = point;
  }
  return best;
}

/// Solid angle of the triangle from x over 4 pi, positive from inside (Van Oosterom and Strackee 1983).
inline double winding(const Vec3 &x, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const Vec3 r = a - x, s = b - x, t = c - x;
  const double l = r.norm(), m = s.norm(), n = t.norm();
  return std::atan2(r.dot(s.cross(t)), l * m * n + r.dot(s) * n + s.dot(t) * l + t.dot(r) * m) /
         (2 * pi);
}

}    // namespace test
