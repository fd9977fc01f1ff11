#pragma once

#include "geometry/vec3.h"

#include <Eigen/Geometry>
#include <array>

namespace rbc {

/// Shares of a triangle's area nearest to each of its corners, from its edges out of corner 0: cut
/// at the circumcentre, or at the middle of the longest edge if the triangle is obtuse (Meyer et
/// al., Visualization and Mathematics III (2003) 35).
inline std::array<double, 3> mixed_corner_shares(const Vec3 &e1, const Vec3 &e2)
{
  const double a = e1.squaredNorm(), b = e2.squaredNorm(), d = e1.dot(e2);
  const std::array<double, 3> dot{d, a - d, b - d};           // of the edges out of each corner
  const std::array<double, 3> facing{a + b - 2 * d, b, a};    // squared length
  for (int c = 0; c < 3; ++c)
    if (dot[c] < 0) {
      std::array<double, 3> shares{0.25, 0.25, 0.25};
      shares[c] = 0.5;
      return shares;
    }
  // (l^2 cot of the facing corner, for the two edges) / 8 over the area, with cot = dot / (2 area)
  const double sixteen_squares = 4 * e1.cross(e2).squaredNorm();
  std::array<double, 3> shares;
  for (int c = 0; c < 3; ++c) {
    const int p = (c + 1) % 3, q = (c + 2) % 3;
    shares[c] = (facing[p] * dot[p] + facing[q] * dot[q]) / sixteen_squares;
  }
  return shares;
}

}    // namespace rbc
