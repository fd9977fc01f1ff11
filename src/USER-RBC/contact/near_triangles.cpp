#include "contact/near_triangles.h"

#include "geometry/arc_tangent.h"
#include "geometry/closest_point.h"
#include "geometry/signed_distance.h"
#include "geometry/spatial_bins.h"
#include "geometry/vector_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rbc {

namespace {

// distance over an edge's length below which the line to a point has no direction

constexpr double TOUCHING = 1e-10;

// loops run on into what is no sphere any more, so that they have no rest that is not vectorised

constexpr int LANES = 8;

int whole_lanes(int count)
{
  return (count + LANES - 1) / LANES * LANES;
}

PlainVector at(const double *x, int n)
{
  return {x[3 * std::size_t(n)], x[3 * std::size_t(n) + 1], x[3 * std::size_t(n) + 2]};
}

double square(double s)
{
  return s * s;
}

}    // namespace

void NearTriangles::Spheres::resize(std::size_t size)
{
  for (auto *numbers : {&x, &y, &z, &radius}) numbers->resize(size + LANES);
  surface.resize(size + LANES);
  triangle.resize(size);
}

void NearTriangles::Spheres::set(int n, PlainVector centre, double r, Surface s, int t)
{
  x[n] = centre.x;
  y[n] = centre.y;
  z[n] = centre.z;
  radius[n] = r;
  surface[n] = s;
  triangle[n] = t;
}

void NearTriangles::build(int points, const Surface *surfaces, int corners, const double *x,
                          const std::vector<Triangle> &triangles, double range, double slack,
                          double travel, SeesOwn sees_own)
{
  sees_own_ = std::move(sees_own);
  surfaces_.assign(surfaces, surfaces + points);
  triangles_ = triangles;
  reach_ = range + slack;
  slack_ = slack;
  travel_ = travel;
  find_incident(corners);
  corners_ = corners;
  rebuild(x);
}

void NearTriangles::rebuild(const double *x)
{
  const double radius = bound_triangles(x), far = reach_ + radius;
  const double all_corners = reach_ + 2 * radius;    // of triangles in reach are as near
  motion_.hold(x, corners_, std::max(all_corners + slack_, (all_corners + travel_) / 2));
  const SpatialBins bins(x, corners_, far);
  sort_spheres(bins);
  find_surface_ranges(bins);

  groups_.clear();
  candidates_.clear();
  for (int n = 0; n < static_cast<int>(surfaces_.size()); ++n) {
    if (surfaces_[n] == NO_SURFACE) continue;
    const PlainVector point = at(x, n);
    const Surface unseen = sees_own_ ? NO_SURFACE : surfaces_[n];
    if (around_bin_[bins.of(point)].none_but(unseen)) continue;
    find_hits(bins, point, unseen, far);
    add_candidates(x, n);
  }
}

/* ----------------------------------------------------------------------
   returns the largest radius
------------------------------------------------------------------------- */

double NearTriangles::bound_triangles(const double *x)
{
  bounds_.resize(triangles_.size());
  double largest2 = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const PlainVector a = at(x, triangles_[t].corner[0]), b = at(x, triangles_[t].corner[1]),
                      c = at(x, triangles_[t].corner[2]);
    const PlainVector centre = (1.0 / 3) * (a + b + c);
    const double radius2 = std::max(
        {dot(a - centre, a - centre), dot(b - centre, b - centre), dot(c - centre, c - centre)});
    largest2 = std::max(largest2, radius2);
    bounds_[t] = {centre, std::sqrt(radius2)};
  }
  return std::sqrt(largest2);
}

void NearTriangles::sort_spheres(const SpatialBins &bins)
{
  const std::size_t count = triangles_.size();
  bin_begin_.assign(bins.count() + 1, 0);
  bin_of_.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    bin_of_[t] = bins.of(bounds_[t].centre);
    ++bin_begin_[bin_of_[t] + 1];
  }
  for (int b = 0; b < bins.count(); ++b) bin_begin_[b + 1] += bin_begin_[b];
  next_.assign(bin_begin_.begin(), bin_begin_.end() - 1);
  spheres_.resize(count);
  for (std::size_t t = 0; t < count; ++t)
    spheres_.set(next_[bin_of_[t]]++, bounds_[t].centre, bounds_[t].radius, triangles_[t].surface,
                 static_cast<int>(t));
}

void NearTriangles::SurfaceRange::add(const SurfaceRange &other)
{
  lowest = std::min(lowest, other.lowest);
  highest = std::max(highest, other.highest);
}

void NearTriangles::find_surface_ranges(const SpatialBins &bins)
{
  in_bin_.assign(bins.count(), {std::numeric_limits<Surface>::max(), NO_SURFACE});
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Surface surface = triangles_[t].surface;
    in_bin_[bin_of_[t]].add({surface, surface});
  }
  around_bin_ = in_bin_;
  const int count[3] = {bins.count(0), bins.count(1), bins.count(2)};
  merge_neighbors(count, around_bin_, scratch_);
}

bool NearTriangles::any_seen(int first_bin, int last_bin, Surface unseen) const
{
  for (int b = first_bin; b <= last_bin; ++b)
    if (!in_bin_[b].none_but(unseen)) return true;
  return false;
}

/* ----------------------------------------------------------------------
   triangles whose spheres are in reach of a point: those of a row of bins follow each other
------------------------------------------------------------------------- */

void NearTriangles::find_hits(const SpatialBins &bins, PlainVector p, Surface unseen, double far)
{
  hit_count_ = 0;
  const int j0 = bins.along(1, p.y - far), j1 = bins.along(1, p.y + far);
  const int k0 = bins.along(2, p.z - far), k1 = bins.along(2, p.z + far);
  constexpr int most = 64;
  static_assert(most % LANES == 0);
  std::int64_t hit[most];    // as wide as all others in the loop
  for (int k = k0; k <= k1; ++k)
    for (int j = j0; j <= j1; ++j) {
      const double left =
          square(far) - square(bins.distance(1, j, p.y)) - square(bins.distance(2, k, p.z));
      if (left < 0) continue;
      const double along = std::sqrt(left);
      const int first_bin = bins.index(bins.along(0, p.x - along), j, k);
      const int last_bin = bins.index(bins.along(0, p.x + along), j, k);
      if (!any_seen(first_bin, last_bin, unseen)) continue;
      const int begin = bin_begin_[first_bin], end = bin_begin_[last_bin + 1];
      for (int first = begin; first < end; first += most) {
        const int count = std::min(most, end - first);
        const double *const x = &spheres_.x[first], *const y = &spheres_.y[first],
                            *const z = &spheres_.z[first], *const radius = &spheres_.radius[first];
        const Surface *const surface = &spheres_.surface[first];
        for_each(whole_lanes(count), [&](int n) {
          const double apart2 = square(x[n] - p.x) + square(y[n] - p.y) + square(z[n] - p.z);
          hit[n] = (apart2 <= square(reach_ + radius[n])) & (surface[n] != unseen);
        });
        if (hits_.size() < std::size_t(hit_count_ + most)) hits_.resize(2 * (hit_count_ + most));
        for (int n = 0; n < count; ++n) {    // without branches: hits come at random
          hits_[hit_count_] = spheres_.triangle[first + n];
          hit_count_ += hit[n];
        }
      }
    }
}

void NearTriangles::add_candidates(const double *x, int point)
{
  const std::size_t first = candidates_.size();
  constexpr int most = 16;
  double corner[9][most], distance2[most];
  for (int begin = 0; begin < hit_count_; begin += most) {
    const int count = std::min(most, hit_count_ - begin);
    for (int n = 0; n < most; ++n) {    // the rest is filled up, so that loops have one length
      const Triangle &triangle = triangles_[hits_[begin + std::min(n, count - 1)]];
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          corner[3 * c + d][n] = x[3 * std::size_t(triangle.corner[c]) + d];
    }
    const PlainVector p = at(x, point);
    for_each(most, [&](int n) {
      const auto of = [&](int c) {
        return PlainVector{corner[c][n], corner[c + 1][n], corner[c + 2][n]};
      };
      distance2[n] = triangle_distance_square(p, of(0), of(3), of(6));
    });
    for (int n = 0; n < count; ++n) {
      const int t = hits_[begin + n];
      const Surface surface = triangles_[t].surface;
      if (!(distance2[n] <= square(reach_))) continue;
      if (surface == surfaces_[point] && !sees_own_(point, t)) continue;
      candidates_.push_back({surface, std::sqrt(distance2[n]), t});
    }
  }
  std::sort(candidates_.begin() + first, candidates_.end(),
            [](const Candidate &a, const Candidate &b) {
              return a.surface != b.surface ? a.surface < b.surface : a.distance < b.distance;
            });
  for (std::size_t c = first; c < candidates_.size(); ++c) {
    if (c == first || candidates_[c].surface != candidates_[c - 1].surface)
      groups_.push_back({point, static_cast<int>(c), 0});
    groups_.back().end = static_cast<int>(c) + 1;
  }
}

void NearTriangles::find_incident(int corners)
{
  incident_begin_.assign(corners + 1, 0);
  for (const Triangle &triangle : triangles_)
    for (int v : triangle.corner) ++incident_begin_[v + 1];
  for (int v = 0; v < corners; ++v) incident_begin_[v + 1] += incident_begin_[v];
  incident_.resize(incident_begin_[corners]);
  next_.assign(incident_begin_.begin(), incident_begin_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (int v : triangles_[t].corner) incident_[next_[v]++] = static_cast<int>(t);
}

/* ----------------------------------------------------------------------
   a triangle with a corner further away than `near` was beyond reach by `slack`
------------------------------------------------------------------------- */

double NearTriangles::largest_approach(const double *x)
{
  const auto [near, wider] = motion_.differences(x);
  return std::max(near, wider - slack_);
}

/* ----------------------------------------------------------------------
   no triangle can be nearer than it was less what it and the point came nearer to each other
------------------------------------------------------------------------- */

const std::vector<VertexContact> &NearTriangles::contacts(const double *x, double range)
{
  if (largest_approach(x) > slack_) rebuild(x);
  contacts_.clear();
  for (const Group &group : groups_) {
    const PlainVector p = at(x, group.point);
    const double approach = motion_.around(group.point);
    double nearest2 = square(range);
    const Triangle *nearest = nullptr;
    std::array<double, 3> weight{};
    PlainVector apart{};
    for (int n = group.begin; n < group.end; ++n) {
      const double least = candidates_[n].distance - approach;
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
   direction at the closest point that points out of the surface, as FeatureNormals has it. Surfaces
   move from step to step, so that it is found only where it is needed.
------------------------------------------------------------------------- */

PlainVector NearTriangles::outward(const double *x, const std::array<int, 3> &corner,
                                   const std::array<double, 3> &weight, PlainVector face) const
{
  const TriangleFeature feature(weight);
  const int count = feature.count;
  if (count == 3) return face;
  const int on[2] = {corner[feature.corner[0]], count == 2 ? corner[feature.corner[1]] : -1};

  PlainVector sum{0, 0, 0};
  for (int f = incident_begin_[on[0]]; f < incident_begin_[on[0] + 1]; ++f) {
    const auto &v = triangles_[incident_[f]].corner;
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
  std::size_t integers = 0;
  for (const auto *numbers : {&incident_begin_, &incident_, &bin_begin_, &bin_of_, &next_, &hits_})
    integers += numbers->capacity();
  return integers * sizeof(int) +
         (in_bin_.capacity() + around_bin_.capacity() + scratch_.capacity()) *
             sizeof(SurfaceRange) +
         surfaces_.capacity() * sizeof(Surface) + triangles_.capacity() * sizeof(Triangle) +
         motion_.bytes() +
         bounds_.capacity() *
             (sizeof(Sphere) + 4 * sizeof(double) + sizeof(Surface) + sizeof(int)) +
         groups_.capacity() * sizeof(Group) + candidates_.capacity() * sizeof(Candidate) +
         contacts_.capacity() * sizeof(VertexContact);
}

}    // namespace rbc
