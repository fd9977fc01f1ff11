#pragma once

#include "geometry/plain_vector.h"

#include <algorithm>
#include <array>

namespace rbc {

/// Weights of a triangle's corners a, b, c at the point of it that is closest to x. A weight is
/// exactly zero where that point is on the edge opposite, or at another corner (Ericson, Real-Time
/// Collision Detection, 2005, section 5.1.5).
inline std::array<double, 3> closest_point_weights(PlainVector x, PlainVector a, PlainVector b,
                                                   PlainVector c)
{
  const PlainVector ab = b - a, ac = c - a;
  const PlainVector ax = x - a, bx = x - b, cx = x - c;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};

  const double wc = d1 * d4 - d3 * d2;
  if (wc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const double wb = d5 * d2 - d1 * d6;
  if (wb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const double wa = d3 * d6 - d5 * d4;
  if (wa <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = wa + wb + wc;
  return {wa / sum, wb / sum, wc / sum};
}

inline PlainVector weighted_point(const std::array<double, 3> &weight, PlainVector a, PlainVector b,
                                  PlainVector c)
{
  return weight[0] * a + weight[1] * b + weight[2] * c;
}

/// Square of the distance from x to a triangle, without branches: for loops that are to be
/// vectorised.
[[gnu::always_inline]] inline double triangle_distance_square(PlainVector x, PlainVector a,
                                                              PlainVector b, PlainVector c)
{
  const PlainVector ab = b - a, bc = c - b, ca = a - c;
  const PlainVector ax = x - a, bx = x - b, cx = x - c;
  const auto to_edge = [](PlainVector edge, PlainVector from) {
    // in this order 0 / 0, of an edge without length, becomes 1
    const double along = std::min(1.0, std::max(dot(from, edge), 0.0) / dot(edge, edge));
    const PlainVector apart = from - along * edge;
    return dot(apart, apart);
  };
  const double edges = std::min(std::min(to_edge(ab, ax), to_edge(bc, bx)), to_edge(ca, cx));
  const PlainVector normal = cross(ab, bc);
  const double area2 = dot(normal, normal), height = dot(ax, normal);
  const double least = std::min(std::min(dot(cross(ab, ax), normal), dot(cross(bc, bx), normal)),
                                dot(cross(ca, cx), normal));
  const double face = height * height / area2;
  return ((least > 0) & (area2 > 0)) ? std::min(face, edges) : edges;
}

}    // namespace rbc
