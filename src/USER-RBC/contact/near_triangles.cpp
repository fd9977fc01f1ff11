#include "contact/near_triangles.h"

#include "geometry/closest_point.h"
#include "geometry/rounding.h"
#include "geometry/spatial_bins.h"
#include "geometry/tight_vector.h"
#include "geometry/vector_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rbc {

namespace {

// the flow is fitted to each of so many points

constexpr int FITTED = 8;

// groups whose nearest triangles are found together

constexpr std::size_t NEAR = 128;

// loops run on into what is no sphere any more, so that they have no rest that is not vectorised

constexpr int LANES = 16;

double square(double s)
{
  return s * s;
}

}    // namespace

void NearTriangles::Spheres::resize(std::size_t size)
{
  for (auto *numbers : {&x, &y, &z, &radius}) resize_tightly(*numbers, size + LANES);
  resize_tightly(surface, size + LANES);
  resize_tightly(triangle, size);
}

void NearTriangles::Spheres::set(int n, const Sphere &sphere, Surface s, int t)
{
  const PlainVector centre = sphere.centre - origin;
  x[n] = static_cast<float>(centre.x);
  y[n] = static_cast<float>(centre.y);
  z[n] = static_cast<float>(centre.z);
  radius[n] = static_cast<float>(sphere.radius + error);
  surface[n] = s;
  triangle[n] = t;
}

void NearTriangles::build(int points, const Surface *surfaces, int corners, const double *x,
                          const std::vector<Triangle> &triangles, double range, double slack,
                          double travel, SeesOwn sees_own)
{
  sees_own_ = std::move(sees_own);
  points_ = points;
  surfaces_ = surfaces;
  triangles_ = &triangles;
  reach_ = range + slack;
  slack_ = slack;
  travel_ = travel;
  around_.fill(corners, bin_of_, [&](const auto &put) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (int v : triangles[t].corner) put(v, static_cast<int>(t));
  });
  corners_ = corners;
  near_.reserve(NEAR);
  rebuild(x);
}

void NearTriangles::rebuild(const double *x)
{
  const double radius = largest_radius(x), far = reach_ + radius;
  const double all_corners = reach_ + 2 * radius;    // of triangles in reach are as near
  motion_.hold(x, corners_, std::max(all_corners + slack_, (all_corners + travel_) / 2));
  hold_flow(x);
  const SpatialBins bins(x, corners_, far);
  sort_spheres(x, bins);
  find_surface_ranges(bins);

  groups_.clear();
  candidates_.distance.clear(reach_);
  candidates_.triangle.clear();
  for (int n = 0; n < points_; ++n) {
    if (surfaces_[n] == NO_SURFACE) continue;
    const PlainVector point = at(x, n);
    const Surface unseen = sees_own_ ? NO_SURFACE : surfaces_[n];
    if (around_bin_[bins.of(point)].none_but(unseen)) continue;
    find_hits(bins, point, unseen, far);
    find_candidates(x, n);
    add_groups(n);
  }
}

NearTriangles::Sphere NearTriangles::sphere_around(const double *x, const Triangle &triangle)
{
  const PlainVector a = at(x, triangle.corner[0]), b = at(x, triangle.corner[1]),
                    c = at(x, triangle.corner[2]);
  const PlainVector centre = (1.0 / 3) * (a + b + c);
  const double radius2 = std::max(
      {dot(a - centre, a - centre), dot(b - centre, b - centre), dot(c - centre, c - centre)});
  return {centre, std::sqrt(radius2)};
}

double NearTriangles::largest_radius(const double *x) const
{
  double largest = 0;
  for (const Triangle &triangle : *triangles_)
    largest = std::max(largest, sphere_around(x, triangle).radius);
  return largest;
}

/* ----------------------------------------------------------------------
   A coordinate of a point or a centre is off by half a digit of single precision, of the size of
   the bins; the distance and its square by some digits of their own.
------------------------------------------------------------------------- */

void NearTriangles::sort_spheres(const double *x, const SpatialBins &bins)
{
  const std::size_t count = triangles_->size();
  reserve_loosely(bin_begin_, bins.count() + 1);
  reserve_loosely(next_, bins.count());
  bin_begin_.assign(bins.count() + 1, 0);
  resize_tightly(bin_of_, count);
  for (std::size_t t = 0; t < count; ++t) {
    bin_of_[t] = bins.of(sphere_around(x, (*triangles_)[t]).centre);
    ++bin_begin_[bin_of_[t] + 1];
  }
  for (int b = 0; b < bins.count(); ++b) bin_begin_[b + 1] += bin_begin_[b];
  next_.assign(bin_begin_.begin(), bin_begin_.end() - 1);
  spheres_.resize(count);
  spheres_.origin = bins.lowest();
  spheres_.error = 8 * std::numeric_limits<float>::epsilon() * (bins.extent() + reach_);
  for (std::size_t t = 0; t < count; ++t)
    spheres_.set(next_[bin_of_[t]]++, sphere_around(x, (*triangles_)[t]), (*triangles_)[t].surface,
                 static_cast<int>(t));
}

void NearTriangles::SurfaceRange::add(const SurfaceRange &other)
{
  lowest = std::min(lowest, other.lowest);
  highest = std::max(highest, other.highest);
}

void NearTriangles::find_surface_ranges(const SpatialBins &bins)
{
  for (auto *ranges : {&in_bin_, &around_bin_, &scratch_}) reserve_loosely(*ranges, bins.count());
  in_bin_.assign(bins.count(), {std::numeric_limits<Surface>::max(), NO_SURFACE});
  for (std::size_t t = 0; t < triangles_->size(); ++t) {
    const Surface surface = (*triangles_)[t].surface;
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
  const int i0 = bins.along(0, p.x - far), i1 = bins.along(0, p.x + far);
  const int j0 = bins.along(1, p.y - far), j1 = bins.along(1, p.y + far);
  const int k0 = bins.along(2, p.z - far), k1 = bins.along(2, p.z + far);
  const PlainVector from = p - spheres_.origin;
  const auto px = static_cast<float>(from.x), py = static_cast<float>(from.y),
             pz = static_cast<float>(from.z), reach = static_cast<float>(reach_);
  for (int k = k0; k <= k1; ++k)
    for (int j = j0; j <= j1; ++j) {
      if (square(bins.distance(1, j, p.y)) + square(bins.distance(2, k, p.z)) > square(far))
        continue;
      const int first_bin = bins.index(i0, j, k), last_bin = bins.index(i1, j, k);
      if (!any_seen(first_bin, last_bin, unseen)) continue;
      const int end = bin_begin_[last_bin + 1];
      for (int first = bin_begin_[first_bin]; first < end; first += LANES) {
        const float *const x = &spheres_.x[first], *const y = &spheres_.y[first],
                           *const z = &spheres_.z[first], *const radius = &spheres_.radius[first];
        const Surface *const surface = &spheres_.surface[first];
        std::uint32_t hits = 0;
#pragma omp simd reduction(| : hits)
        for (int n = 0; n < LANES; ++n) {
          const float dx = x[n] - px, dy = y[n] - py, dz = z[n] - pz, far_off = reach + radius[n];
          const bool hit =
              (dx * dx + dy * dy + dz * dz <= far_off * far_off) & (surface[n] != unseen);
          hits |= std::uint32_t(hit) << n;
        }
        if (end - first < LANES) hits &= (1u << (end - first)) - 1;
        if (hits_.size() < std::size_t(hit_count_ + LANES)) hits_.resize(2 * (hit_count_ + LANES));
        for (; hits; hits &= hits - 1)
          hits_[hit_count_++] = spheres_.triangle[first + __builtin_ctz(hits)];
      }
    }
}

/* ----------------------------------------------------------------------
   calls take(n, square of the distance) for count pairs of a point and the corners of a triangle,
   pair(n)
------------------------------------------------------------------------- */

template <typename Pair, typename Take>
void NearTriangles::visit_distances(const double *x, int count, const Pair &pair,
                                    const Take &take) const
{
  constexpr int most = 16;
  double number[12][most], distance2[most];
  for (int begin = 0; begin < count; begin += most) {
    const int size = std::min(most, count - begin);
    for (int n = 0; n < most; ++n) {    // the rest is filled up, so that loops have one length
      const auto [point, corner] = pair(begin + std::min(n, size - 1));
      for (int d = 0; d < 3; ++d) {
        number[d][n] = x[3 * std::size_t(point) + d];
        for (int c = 0; c < 3; ++c) number[3 + 3 * c + d][n] = x[3 * std::size_t(corner[c]) + d];
      }
    }
    for_each(most, [&](int n) {
      const auto of = [&](int d) {
        return PlainVector{number[d][n], number[d + 1][n], number[d + 2][n]};
      };
      distance2[n] = triangle_distance_square(of(0), of(3), of(6), of(9));
    });
    for (int n = 0; n < size; ++n) take(begin + n, distance2[n]);
  }
}

void NearTriangles::find_candidates(const double *x, int point)
{
  found_.clear();
  visit_distances(
      x, hit_count_, [&](int n) { return std::pair(point, (*triangles_)[hits_[n]].corner.data()); },
      [&](int n, double distance2) {
        const int t = hits_[n];
        const Surface surface = (*triangles_)[t].surface;
        if (!(distance2 <= square(reach_))) return;
        if (surface == surfaces_[point] && !sees_own_(point, t)) return;
        found_.push_back({surface, rounded_down(std::sqrt(distance2)), t});
      });
}

void NearTriangles::add_groups(int point)
{
  for (auto begin = found_.begin(), end = begin; begin != found_.end(); begin = end) {
    const Surface surface = begin->surface;
    end = std::partition(begin, found_.end(),
                         [&](const Found &found) { return found.surface == surface; });
    Group group{point, candidates_.count(), begin->distance, candidates_.count(), Side::unknown};
    for (auto found = begin; found != end; ++found) {
      if (found->distance < group.distance) {
        group.distance = found->distance;
        group.nearest = candidates_.count();
      }
      candidates_.distance.push_back(found->distance);
      push_back_tightly(candidates_.triangle, found->triangle);
    }
    push_back_tightly(groups_, group);
  }
}

int NearTriangles::end_of(int group) const
{
  const std::size_t next = std::size_t(group) + 1;
  return next < groups_.size() ? groups_[next].begin : candidates_.count();
}

double NearTriangles::largest_approach(const double *x)
{
  fit_flow(x);
  const double approach = approach_beyond(x, flow_);
  return approach <= slack_ ? approach : std::min(approach, approach_beyond(x, {}));
}

/* ----------------------------------------------------------------------
   A triangle with a corner further away than `near` was beyond reach by `slack`. A closer bound is
   looked for where the first is too large.
------------------------------------------------------------------------- */

double NearTriangles::approach_beyond(const double *x, const LinearFlow &flow)
{
  strain_ = flow.norm();
  const auto [near, wider] = motion_.differences(x, flow);
  const double range = reach_ - slack_;
  const double approach = held_distance(range, near) - range,
               of_wider = held_distance(range, wider) - range - slack_;
  if (std::max(approach, of_wider) <= slack_ || !(of_wider <= slack_))
    return std::max(approach, of_wider);
  return std::max(held_distance(range, motion_.closer_difference(x, flow)) - range, of_wider);
}

void NearTriangles::hold_flow(const double *x)
{
  strain_ = 0;
  PlainVector sum{0, 0, 0};
  int count = 0;
  for (int n = 0; n < corners_; n += FITTED, ++count) sum = sum + at(x, n);
  if (count > 0) flow_.reset((1.0 / count) * sum);
  for (int n = 0; n < corners_; n += FITTED) flow_.place(at(x, n));
}

void NearTriangles::fit_flow(const double *x)
{
  flow_.begin();
  for (int n = 0; n < corners_; n += FITTED) flow_.add(motion_.held(n), at(x, n) - motion_.held(n));
  flow_.fit();
}

/* ----------------------------------------------------------------------
   Takes groups from the given one on that may be in range, as many as stay in the processor's cache
   until their contacts are found. Returns the first group that was not looked at.
------------------------------------------------------------------------- */

std::size_t NearTriangles::find_near_groups(std::size_t g, double range)
{
  near_.clear();
  for (; g < groups_.size() && near_.size() < NEAR; ++g) {
    const Group &group = groups_[g];
    if (group.distance <= held_distance(range, motion_.around(group.point)))
      near_.push_back({static_cast<int>(g), 0});
  }
  return g;
}

/* ----------------------------------------------------------------------
   Finds the nearest triangle of each near group. No triangle can be nearer than it was less
   what it and the point came nearer to each other. The one that was nearest last time comes first,
   so that few of the others need a look.
------------------------------------------------------------------------- */

void NearTriangles::find_nearest(const double *x, double range)
{
  visit_distances(
      x, static_cast<int>(near_.size()),
      [&](int n) {
        const Group &group = groups_[near_[n].group];
        return std::pair(group.point, corners(group.nearest));
      },
      [&](int n, double distance2) { near_[n].distance2 = distance2; });

  int count = 0;
  for (std::size_t g = 0; g < near_.size(); ++g) {
    const Group &group = groups_[near_[g].group];
    const double nearer = std::min(range, std::sqrt(near_[g].distance2));
    const auto far = candidates_.distance.parts(held_distance(nearer, motion_.around(group.point)));
    const int end = end_of(near_[g].group);
    if (others_.size() < std::size_t(count + end - group.begin))
      others_.resize(2 * others_.size() + end - group.begin);
    for (int n = group.begin; n < end; ++n) {    // without branches: distances come in any order
      others_[count] = {static_cast<int>(g), n};
      count += (candidates_.distance[n] <= far) & (n != group.nearest);
    }
  }
  visit_distances(
      x, count,
      [&](int n) {
        const auto &[g, candidate] = others_[n];
        return std::pair(groups_[near_[g].group].point, corners(candidate));
      },
      [&](int n, double distance2) {
        const auto &[g, candidate] = others_[n];
        if (distance2 >= near_[g].distance2) return;
        near_[g].distance2 = distance2;
        groups_[near_[g].group].nearest = candidate;
      });
}

const int *NearTriangles::corners(int candidate) const
{
  return (*triangles_)[candidates_.triangle[candidate]].corner.data();
}

const std::vector<VertexContact> &NearTriangles::contacts(const double *x, double range)
{
  if (largest_approach(x) > slack_) rebuild(x);
  contacts_.clear();
  for (std::size_t begin = 0; begin < groups_.size();) {
    begin = find_near_groups(begin, range);
    find_nearest(x, range);
    for (const auto &[group, distance2] : near_)
      if (distance2 < square(range)) add_contact(x, groups_[group]);
  }
  return contacts_;
}

std::size_t NearTriangles::bytes() const
{
  std::size_t integers = 0;
  for (const auto *numbers : {&bin_begin_, &bin_of_, &next_, &hits_})
    integers += numbers->capacity();
  return integers * sizeof(int) + around_.bytes() + found_.capacity() * sizeof(Found) +
         (in_bin_.capacity() + around_bin_.capacity() + scratch_.capacity()) *
             sizeof(SurfaceRange) +
         motion_.bytes() +
         spheres_.triangle.capacity() * (4 * sizeof(float) + sizeof(Surface) + sizeof(int)) +
         groups_.capacity() * sizeof(Group) + near_.capacity() * sizeof(Near) +
         others_.capacity() * sizeof(others_[0]) + candidates_.distance.bytes() +
         candidates_.triangle.capacity() * sizeof(int) +
         contacts_.capacity() * sizeof(VertexContact);
}

}    // namespace rbc
