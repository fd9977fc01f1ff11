#pragma once

#include "surface_template.h"

#include <cmath>

namespace rbc {

/// Angle between the normals of the triangles of a hinge, positive where the surface is convex.
inline double hinge_angle(const Vec3 &edge_direction, const Vec3 &normal_left,
                          const Vec3 &normal_right)
{
  return std::atan2(normal_left.cross(normal_right).dot(edge_direction),
                    normal_left.dot(normal_right));
}

}    // namespace rbc
