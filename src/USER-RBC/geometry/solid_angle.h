#pragma once

#include "geometry/vec3.h"

#include <Eigen/Geometry>

#include <cmath>

namespace rbc {

/// Solid angle that the triangle abc fills, seen from the origin: positive where a, b, c turn
/// right-handed about the direction of sight. A closed surface whose triangles are right-handed
/// outward fills 4 pi seen from inside, and 0 seen from outside (van Oosterom and Strackee, IEEE
/// Trans Biomed Eng 30, 125, 1983).
inline double solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const double na = a.norm(), nb = b.norm(), nc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
}

}    // namespace rbc
