#include "near_triangles.h"

#include "arc_tangent.h"
#include "closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rbc {

namespace {

// distance over an edge's length below which the line to a point has no direction

constexpr double TOUCHING = 1e-10;

PlainVector at(const double *x, int n)
{
  return {x[3 * std::size_t(n)], x[3 * std::size_t(n) + 1], x[3 * std::size_t(n) + 2]};
}

double square(double s)
{
  return s * s;
}

/// Boxes of equal size that cover the points; what is outside counts to those at the rim.
class Bins {
 public:
  Bins(const double *x, int points, double size)
  {
    constexpr double most = 1e6;
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = std::numeric_limits<double>::max();
      hi[d] = -lo[d];
    }
    for (int n = 0; n < points; ++n)
      for (int d = 0; d < 3; ++d) {
        lo[d] = std::min(lo[d], x[3 * std::size_t(n) + d]);
        hi[d] = std::max(hi[d], x[3 * std::size_t(n) + d]);
      }
    double volume = 1;
    for (int d = 0; d < 3; ++d) volume *= std::max(hi[d] - lo[d], size);
    size = std::max(size, std::cbrt(volume / most));
    for (int d = 0; d < 3; ++d) {
      lo_[d] = lo[d];
      count_[d] = points > 0 ? static_cast<int>((hi[d] - lo[d]) / size) + 1 : 1;
    }
    inverse_ = 1 / size;
  }

  int count() const { return count_[0] * count_[1] * count_[2]; }
  int index(int i, int j, int k) const { return i + count_[0] * (j + count_[1] * k); }
  int along(int d, double x) const
  {
    return static_cast<int>(std::min(std::max(0.0, (x - lo_[d]) * inverse_), count_[d] - 1.0));
  }
  int of(PlainVector x) const { return index(along(0, x.x), along(1, x.y), along(2, x.z)); }

 private:
  double lo_[3], inverse_;
  int count_[3];
};

}    // namespace

void NearTriangles::build(int points, const Surface *surfaces, int corners, const double *x,
                          const std::vector<Triangle> &triangles, double range, double slack)
{
  triangles_ = triangles;
  built_.assign(x, x + 3 * std::size_t(std::max(points, corners)));
  build_fans(corners);
  bound(x);

  double largest = 0;
  for (const Sphere &sphere : spheres_) largest = std::max(largest, sphere.radius);
  const double reach = range + slack, far = reach + largest;
  const Bins bins(x, corners, far / 2);
  bin_begin_.assign(bins.count() + 1, 0);
  bin_of_.resize(spheres_.size());
  for (std::size_t s = 0; s < spheres_.size(); ++s) {
    bin_of_[s] = bins.of(spheres_[s].centre);
    ++bin_begin_[bin_of_[s] + 1];
  }
  for (int b = 0; b < bins.count(); ++b) bin_begin_[b + 1] += bin_begin_[b];
  sorted_.resize(spheres_.size());
  std::vector<int> next(bin_begin_.begin(), bin_begin_.end() - 1);
  for (std::size_t s = 0; s < spheres_.size(); ++s) sorted_[next[bin_of_[s]]++] = spheres_[s];

  groups_.clear();
  candidates_.clear();
  for (int n = 0; n < points; ++n) {
    const PlainVector p = at(x, n);
    const std::size_t first = candidates_.size();
    const int i0 = bins.along(0, p.x - far), i1 = bins.along(0, p.x + far);
    const int j0 = bins.along(1, p.y - far), j1 = bins.along(1, p.y + far);
    const int k0 = bins.along(2, p.z - far), k1 = bins.along(2, p.z + far);
    for (int k = k0; k <= k1; ++k)
      for (int j = j0; j <= j1; ++j)
        for (int s = bin_begin_[bins.index(i0, j, k)]; s < bin_begin_[bins.index(i1, j, k) + 1];
             ++s) {
          const Sphere &sphere = sorted_[s];
          const PlainVector apart = p - sphere.centre;
          if (dot(apart, apart) > square(reach + sphere.radius)) continue;
          const Triangle &triangle = triangles_[sphere.triangle];
          if (triangle.surface == surfaces[n]) continue;
          const PlainVector a = at(x, triangle.corner[0]), b = at(x, triangle.corner[1]),
                            c = at(x, triangle.corner[2]);
          const double distance =
              norm(p - weighted_point(closest_point_weights(p, a, b, c), a, b, c));
          if (distance <= reach)
            candidates_.push_back({triangle.surface, distance, sphere.triangle});
        }
    if (candidates_.size() == first) continue;
    std::sort(candidates_.begin() + first, candidates_.end(),
              [](const Candidate &a, const Candidate &b) {
                return a.surface != b.surface ? a.surface < b.surface : a.distance < b.distance;
              });
    for (std::size_t c = first; c < candidates_.size(); ++c) {
      if (c == first || candidates_[c].surface != candidates_[c - 1].surface)
        groups_.push_back({n, static_cast<int>(c), 0});
      groups_.back().end = static_cast<int>(c) + 1;
    }
  }
}

void NearTriangles::build_fans(int corners)
{
  fan_begin_.assign(corners + 1, 0);
  for (const Triangle &triangle : triangles_)
    for (int v : triangle.corner) ++fan_begin_[v + 1];
  for (int v = 0; v < corners; ++v) fan_begin_[v + 1] += fan_begin_[v];
  fans_.resize(fan_begin_[corners]);
  std::vector<int> next(fan_begin_.begin(), fan_begin_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (int v : triangles_[t].corner) fans_[next[v]++] = static_cast<int>(t);
}

void NearTriangles::bound(const double *x)
{
  spheres_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const PlainVector a = at(x, triangles_[t].corner[0]), b = at(x, triangles_[t].corner[1]),
                      c = at(x, triangles_[t].corner[2]);
    const PlainVector centre = (1.0 / 3) * (a + b + c);
    const double radius2 = std::max(
        {dot(a - centre, a - centre), dot(b - centre, b - centre), dot(c - centre, c - centre)});
    spheres_[t] = {centre, std::sqrt(radius2), static_cast<int>(t)};
  }
}

double NearTriangles::largest_displacement(const double *x) const
{
  double largest2 = 0;
  for (std::size_t n = 0; n < built_.size(); n += 3)
    largest2 = std::max(largest2, square(x[n] - built_[n]) + square(x[n + 1] - built_[n + 1]) +
                                      square(x[n + 2] - built_[n + 2]));
  return std::sqrt(largest2);
}

/* ----------------------------------------------------------------------
   no triangle can be nearer than it was less what it and the point moved
------------------------------------------------------------------------- */

const std::vector<NearTriangles::Contact> &NearTriangles::contacts(const double *x, double range,
                                                                   double moved)
{
  contacts_.clear();
  for (const Group &group : groups_) {
    const PlainVector p = at(x, group.point);
    double nearest2 = square(range);
    const Triangle *nearest = nullptr;
    std::array<double, 3> weight{};
    PlainVector apart{};
    for (int n = group.begin; n < group.end; ++n) {
      const double least = candidates_[n].distance - 2 * moved;
      if (least > 0 && square(least) > nearest2) break;
      const Triangle &triangle = triangles_[candidates_[n].triangle];
      const PlainVector a = at(x, triangle.corner[0]), b = at(x, triangle.corner[1]),
                        c = at(x, triangle.corner[2]);
      const auto w = closest_point_weights(p, a, b, c);
      const PlainVector r = p - weighted_point(w, a, b, c);
      const double r2 = dot(r, r);
      if (r2 >= nearest2) continue;
      nearest2 = r2;
      nearest = &triangle;
      weight = w;
      apart = r;
    }
    if (!nearest) continue;

    const PlainVector a = at(x, nearest->corner[0]), b = at(x, nearest->corner[1]),
                      c = at(x, nearest->corner[2]);
    const PlainVector out = outward(x, nearest->corner, weight, cross(b - a, c - a));
    const double distance = std::sqrt(nearest2);
    const bool inside = dot(apart, out) < 0;
    const bool has_direction = nearest2 > square(TOUCHING) * dot(b - a, b - a);
    const PlainVector normal =
        has_direction ? (inside ? -1 / distance : 1 / distance) * apart : (1 / norm(out)) * out;
    contacts_.push_back(
        {group.point, nearest->corner, weight, normal, inside ? -distance : distance});
  }
  return contacts_;
}

/* ----------------------------------------------------------------------
   direction that points out of the surface at the closest point: the sum of the normals of the triangles that meet
   there, at a corner weighted by their angles (Baerentzen and Aanaes, IEEE Trans Vis Comput Graph 11, 243, 2005)
------------------------------------------------------------------------- */

PlainVector NearTriangles::outward(const double *x, const std::array<int, 3> &corner,
                                   const std::array<double, 3> &weight, PlainVector face) const
{
  int on[3], count = 0;
  for (int c = 0; c < 3; ++c)
    if (weight[c] != 0) on[count++] = corner[c];
  if (count == 3) return face;

  PlainVector sum{0, 0, 0};
  for (int f = fan_begin_[on[0]]; f < fan_begin_[on[0] + 1]; ++f) {
    const auto &v = triangles_[fans_[f]].corner;
    const int place = v[0] == on[0] ? 0 : v[1] == on[0] ? 1 : 2;
    const int next = v[(place + 1) % 3], last = v[(place + 2) % 3];
    if (count == 2 && next != on[1] && last != on[1]) continue;
    const PlainVector to_next = at(x, next) - at(x, on[0]), to_last = at(x, last) - at(x, on[0]);
    const PlainVector normal = cross(to_next, to_last);
    const double length = norm(normal);
    const double angle = count == 2 ? 1 : arc_tangent(length, dot(to_next, to_last));
    sum = sum + (angle / length) * normal;
  }
  return sum;
}

std::size_t NearTriangles::bytes() const
{
  return triangles_.capacity() * sizeof(Triangle) +
         (fan_begin_.capacity() + fans_.capacity() + bin_begin_.capacity() + bin_of_.capacity()) *
             sizeof(int) +
         built_.capacity() * sizeof(double) +
         (spheres_.capacity() + sorted_.capacity()) * sizeof(Sphere) +
         groups_.capacity() * sizeof(Group) + candidates_.capacity() * sizeof(Candidate) +
         contacts_.capacity() * sizeof(Contact);
}

}    // namespace rbc
