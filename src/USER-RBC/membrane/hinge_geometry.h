#pragma once

#include "geometry/plain_vector.h"

namespace rbc {

/// Of the angle between the normals of the triangles of a hinge, positive where the surface is
/// convex.
struct HingeAngle {
  double sine, cosine;
};

inline HingeAngle hinge_angle(PlainVector edge_direction, PlainVector normal_left,
                              PlainVector normal_right)
{
  return {dot(cross(normal_left, normal_right), edge_direction), dot(normal_left, normal_right)};
}

}    // namespace rbc
