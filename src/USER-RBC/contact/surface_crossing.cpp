#include "contact/surface_crossing.h"

#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>

namespace rbc {

namespace {

// Distance of what touches, over sizes and displacements. A line between closest points that is
// much shorter has no direction any more: its products with lines of the size are round-off.

constexpr double TOUCHING = 1e-6;
constexpr int MOST_ADVANCES = 1000;

PlainVector line_to_triangle(PlainVector p, PlainVector a, PlainVector b, PlainVector c)
{
  return p - weighted_point(closest_point_weights(p, a, b, c), a, b, c);
}

/// The largest distance between a point of the one and a point of the other, and by how much at
/// most the one moves relative to the other.
struct Extent {
  double size2 = 0, motion2 = 0;

  template <typename First, typename Second> Extent(const First &first, const Second &second)
  {
    for (const MovingPoint &p : first)
      for (const MovingPoint &q : second) {
        const PlainVector before = p.start - q.start, moved = p.end - q.end - before;
        size2 = std::max(size2, dot(before, before));
        motion2 = std::max(motion2, dot(moved, moved));
      }
  }
};

/// The first time at which a corner of the one is no longer beyond all corners of the other along
/// `line`; above 1 if that never comes in the step.
template <typename First, typename Second>
double apart_until(const First &first, const Second &second, PlainVector line)
{
  double until = 2;
  for (const MovingPoint &p : first)
    for (const MovingPoint &q : second) {
      const double end = dot(line, p.end - q.end);
      if (end > 0) continue;
      const double start = dot(line, p.start - q.start);
      until = std::min(until, start / (start - end));
    }
  return until;
}

/// `line(time)` leads from the closest point of the second to that of the first.
template <typename First, typename Second, typename Line>
bool touch_in_step(const First &first, const Second &second, const Line &line)
{
  const Extent extent(first, second);
  const double motion = std::sqrt(extent.motion2);
  const double near = TOUCHING * (std::sqrt(extent.size2) + motion);
  double time = 0;
  for (int n = 0; n < MOST_ADVANCES; ++n) {
    const PlainVector r = line(time);
    const double distance = norm(r);
    if (distance <= near) return true;
    const double until = apart_until(first, second, r);
    if (until > 1) return false;
    // Round-off in r may give a time that has passed. The half keeps on the safe side of it.
    time = std::max(until, time + distance / (2 * motion));
    if (time > 1) return false;
  }
  return true;
}

bool touch_alone(const MovingPoint &point, const MovingTriangle &triangle)
{
  const std::array<MovingPoint, 1> alone{point};
  return touch_in_step(alone, triangle, [&](double time) {
    return line_to_triangle(point.at(time), triangle[0].at(time), triangle[1].at(time),
                            triangle[2].at(time));
  });
}

bool touch_alone(const MovingEdge &first, const MovingEdge &second)
{
  return touch_in_step(first, second, [&](double time) {
    return line_between_edges(first[0].at(time), first[1].at(time), second[0].at(time),
                              second[1].at(time));
  });
}

/// The frame of a point that moves, in which positions that are far from the origin have no more
/// round-off than those near it.
template <std::size_t N>
std::array<MovingPoint, N> beside(const MovingPoint &origin, std::array<MovingPoint, N> points)
{
  for (MovingPoint &p : points) p = {p.start - origin.start, p.end - origin.end};
  return points;
}

}    // namespace

bool touch(const MovingPoint &point, const MovingTriangle &triangle)
{
  const MovingPoint origin{{0, 0, 0}, {0, 0, 0}};
  return touch_alone(origin, beside(point, triangle));
}

bool touch(const MovingEdge &first, const MovingEdge &second)
{
  return touch_alone(beside(first[0], first), beside(first[0], second));
}

bool touch(const MovingTriangle &first, const MovingTriangle &second)
{
  const MovingTriangle a = beside(first[0], first), b = beside(first[0], second);
  for (int i = 0; i < 3; ++i) {
    if (touch_alone(a[i], b) || touch_alone(b[i], a)) return true;
    for (int j = 0; j < 3; ++j)
      if (touch_alone(MovingEdge{a[i], a[(i + 1) % 3]}, MovingEdge{b[j], b[(j + 1) % 3]}))
        return true;
  }
  return false;
}

/* ----------------------------------------------------------------------
   Ericson, Real-Time Collision Detection, 2005, section 5.1.9
------------------------------------------------------------------------- */

PlainVector line_between_edges(PlainVector a, PlainVector b, PlainVector c, PlainVector d)
{
  const PlainVector u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  const auto share = [](double part, double whole) {
    return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
  };
  double s = share(uv * vw - uw * vv, uu * vv - uv * uv);
  const double t = share(uv * s + vw, vv);
  s = share(uv * t - uw, uu);
  return w + s * u - t * v;
}

PlainVector line_between(const std::array<PlainVector, 3> &first,
                         const std::array<PlainVector, 3> &second)
{
  PlainVector shortest = first[0] - second[0];
  const auto take = [&shortest](PlainVector line) {
    if (dot(line, line) < dot(shortest, shortest)) shortest = line;
  };
  for (int i = 0; i < 3; ++i) {
    take(line_to_triangle(first[i], second[0], second[1], second[2]));
    take(-1 * line_to_triangle(second[i], first[0], first[1], first[2]));
    for (int j = 0; j < 3; ++j)
      take(line_between_edges(first[i], first[(i + 1) % 3], second[j], second[(j + 1) % 3]));
  }
  return shortest;
}

}    // namespace rbc
