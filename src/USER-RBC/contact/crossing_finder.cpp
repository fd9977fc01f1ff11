#include "contact/crossing_finder.h"

#include "geometry/rounding.h"
#include "geometry/tight_vector.h"
#include "geometry/triangle_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace rbc {

namespace {

constexpr double TOUCHING = 1e-5;    // of the size of fans: distance of triangles that touch

// A list that does not hold for a step is made anew for this much more than it lacked.

constexpr double WIDER = 1.25;

// After a build the reach is this much larger than what was needed between the two builds before,
// so that one list holds until the next. At least this part of the margin, and that where nothing
// is known.

constexpr double LONGER = 1.3, LEAST = 0.1;

// Two triangles of fans that were listed are not, if they are this much further apart than the
// reach: since the list was made, and until the next, they come nearer by less than the reach, in
// coordinates in which distances are no less than 2/3 of what they are.

constexpr double SPLIT = 3;

// Part of the reach: no better line is looked for where two fans are that far apart.

constexpr double WIDE = 0.25;

constexpr float UNKNOWN = -std::numeric_limits<float>::infinity();

/// A number by which positions are known again: other positions have another one, but for a chance
/// of 1 in 2^64.
std::uint64_t digest(const double *numbers, std::size_t count)
{
  std::uint64_t all = count;
  for (std::size_t n = 0; n < count; ++n) {
    std::uint64_t bits;
    std::memcpy(&bits, &numbers[n], sizeof(bits));
    all = (all ^ bits) * 0x9E3779B97F4A7C15u;
    all ^= all >> 32;
  }
  return all;
}

/// Where points are along a line.
template <typename Points> Bounds span(const double *x, const Points &points, PlainVector line)
{
  Bounds bounds{std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
  for (int n : points) {
    const double along = dot(line, at(x, n));
    bounds.lowest = std::min(bounds.lowest, along);
    bounds.highest = std::max(bounds.highest, along);
  }
  return bounds;
}

/// How far the one is beyond the other along a line, negative if it is not.
template <typename Points>
double gap(const double *x, const Points &above, const Points &below, PlainVector line)
{
  return span(x, above, line).lowest - span(x, below, line).highest;
}

PlainVector twice_area(const double *x, const CrossingFinder::Triangle &triangle)
{
  const PlainVector a = at(x, triangle.corner[0]);
  return cross(at(x, triangle.corner[1]) - a, at(x, triangle.corner[2]) - a);
}

std::array<PlainVector, 3> places(const double *x, const CrossingFinder::Triangle &triangle)
{
  return {at(x, triangle.corner[0]), at(x, triangle.corner[1]), at(x, triangle.corner[2])};
}

bool share_corner(const CrossingFinder::Triangle &first, const CrossingFinder::Triangle &second)
{
  for (int v : first.corner)
    for (int w : second.corner)
      if (v == w) return true;
  return false;
}

}    // namespace

CrossingFinder::Line CrossingFinder::unit(PlainVector v)
{
  const double length = norm(v);
  if (!(length > 0) || !std::isfinite(length)) return {Line::UNIT, 0, 0};
  const double scale = Line::UNIT / length;
  const auto toward_zero = [scale](double s) { return static_cast<std::int16_t>(scale * s); };
  return {toward_zero(v.x), toward_zero(v.y), toward_zero(v.z)};
}

CrossingFinder::Sphere CrossingFinder::sphere_around(const double *x, const Triangle &triangle)
{
  const auto [a, b, c] = places(x, triangle);
  const PlainVector centre = (1.0 / 3) * (a + b + c);
  double square = 0;
  for (const PlainVector &corner : {a, b, c})
    square = std::max(square, dot(corner - centre, corner - centre));
  return {centre, std::sqrt(square), -1};
}

CrossingFinder::Corners CrossingFinder::corners(int body, bool fan) const
{
  if (!fan) {
    const auto &corner = (*scene_.triangles)[body].corner;
    return {corner.data(), corner.data() + corner.size()};
  }
  const NumberLists &all = near_.fans().corners;
  return {&all.number[all.begin[body]], all.number.data() + all.begin[body + 1]};
}

bool CrossingFinder::is_owned(int triangle) const
{
  const auto &corner = (*scene_.triangles)[triangle].corner;
  return *std::min_element(corner.begin(), corner.end()) < scene_.owned;
}

void CrossingFinder::build(Scene scene)
{
  scene_ = std::move(scene);
  foreseen_ = std::clamp(LONGER * (since_build_ + needed_), LEAST * scene_.margin, scene_.margin);
  since_build_ = needed_ = 0;
  current_ = false;
  near_.build(*scene_.triangles, scene_.places, scene_.points, scene_.owned, scene_.own_surfaces);
}

/* ----------------------------------------------------------------------
   Mostly a step starts where the last one that was tested has ended.
------------------------------------------------------------------------- */

void CrossingFinder::start(const double *x)
{
  const std::size_t size = 3 * std::size_t(scene_.points);
  current_ = current_ && start_.size() == size &&
             (digest(x, size) == end_ || std::equal(start_.begin(), start_.end(), x));
  start_.assign(x, x + size);
}

CrossingFinder::Outcome CrossingFinder::find(const double *x)
{
  ++counts_.steps;
  end_ = digest(x, start_.size());
  const double held = needed_;    // for what the list was good for so far
  if (!current_) list(start_.data(), foreseen_);
  find_needed_reach(x);
  if (needed_ >= reach_) {
    since_build_ += held;
    list(start_.data(), std::min(WIDER * needed_, scene_.margin));
    find_needed_reach(x);
  }
  while (needed_ >= reach_) {
    current_ = false;
    if (!(needed_ < scene_.furthest)) return {false, {}};
    list(start_.data(), WIDER * needed_);
    find_needed_reach(x);
  }
  std::optional<Pair> found;
  for (std::size_t n = 0; n < listed_.size(); ++n) {
    if (stay_apart(listed_[n], x)) continue;
    if (!listed_[n].fans) {
      if (triangles_touched(listed_[n], x)) found = listed_[n].pair;
      continue;
    }
    const Pair fans = listed_[n].pair;
    listed_[n--] = listed_.back();
    listed_.pop_back();
    const std::size_t before = listed_.size();
    split(start_.data(), fans, SPLIT * reach_);
    for (std::size_t m = before; m < listed_.size(); ++m) listed_[m].gap = UNKNOWN;
  }
  return {true, found};
}

CrossingFinder::Pair CrossingFinder::fans_of(const Listed &listed) const
{
  if (listed.fans) return listed.pair;
  const TriangleFans &fans = near_.fans();
  return {fans.fan(listed.pair.first), fans.fan(listed.pair.second)};
}

bool CrossingFinder::stay_apart(const Listed &listed, const double *x)
{
  if (!listed.apart) return false;
  const Pair fans = fans_of(listed);
  if (motion_.along(fans.first, listed.line).lowest -
          motion_.along(fans.second, listed.line).highest >
      -listed.gap)
    return true;
  return gap(x, corners(listed.pair.first, listed.fans), corners(listed.pair.second, listed.fans),
             listed.line) > 0;
}

/* ----------------------------------------------------------------------
   The reach of a list that holds until corners are at `x`. A pair that is not listed was apart by
   more than the reach; by more than twice that if its fans were no neighbors; by more than four
   times that and two radii if they were not even neighbors of neighbors.
------------------------------------------------------------------------- */

void CrossingFinder::find_needed_reach(const double *x)
{
  const NeighborMotion::Differences moved = motion_.differences(x);
  needed_ = std::max({moved.near, moved.wider / 2, (moved.all - 2 * radius_) / 4});
}

/* ----------------------------------------------------------------------
   Afterwards `apart` holds at the end of the step. The new line was not looked at when listed.
------------------------------------------------------------------------- */

bool CrossingFinder::triangles_touched(Listed &listed, const double *x)
{
  const double *const from = start_.data();
  const auto [first, second] = listed.pair;
  const auto first_start = places(from, (*scene_.triangles)[first]),
             second_start = places(from, (*scene_.triangles)[second]);
  const Corners a = corners(first, false), b = corners(second, false);
  listed.line = unit(line_between(first_start, second_start));
  listed.gap = UNKNOWN;
  listed.apart = gap(from, a, b, listed.line) > 0 && gap(x, a, b, listed.line) > 0;
  if (listed.apart) return false;

  const auto first_end = places(x, (*scene_.triangles)[first]),
             second_end = places(x, (*scene_.triangles)[second]);
  MovingTriangle moving[2];
  for (int c = 0; c < 3; ++c) {
    moving[0][c] = {first_start[c], first_end[c]};
    moving[1][c] = {second_start[c], second_end[c]};
  }
  return touch(moving[0], moving[1]);
}

std::vector<CrossingFinder::Pair> CrossingFinder::crossed(const double *x)
{
  start(x);
  list(x, foreseen_);
  std::vector<Pair> pairs;
  for (const Listed &listed : listed_) {
    if (listed.apart) continue;
    const auto triangle = [&](int t) {
      rbc::Triangle points;
      const auto corner = places(x, (*scene_.triangles)[t]);
      for (int c = 0; c < 3; ++c) points[c] = {corner[c].x, corner[c].y, corner[c].z};
      return points;
    };
    if (distance(triangle(listed.pair.first), triangle(listed.pair.second)) <= TOUCHING * radius_)
      pairs.push_back(listed.pair);
  }
  return pairs;
}

/* ---------------------------------------------------------------------- */

void CrossingFinder::list(const double *x, double reach)
{
  ++counts_.lists;
  reach_ = reach;
  listed_.clear();
  near_.hold(x, reach_);
  radius_ = near_.held().largest_radius();
  motion_.hold(near_.held(), 2 * (radius_ + reach_));
  find_normals(x);
  near_.visit_pairs([&](int first, int second) { consider_fans(x, {first, second}); });
  current_ = true;
}

void CrossingFinder::find_normals(const double *x)
{
  const NumberLists &triangles = near_.fans().triangles;
  resize_tightly(normal_, triangles.count());
  for (int fan : near_.near_owned()) {
    PlainVector sum{0, 0, 0};
    for (int n = triangles.begin[fan]; n < triangles.begin[fan + 1]; ++n)
      sum = sum + twice_area(x, (*scene_.triangles)[triangles.number[n]]);
    normal_[fan].line = unit(sum);
    normal_[fan].along = near_.held().along(fan, normal_[fan].line);
  }
}

/* ----------------------------------------------------------------------
   Lists two fans unless they are beyond reach along a line; if they are not apart, their triangles.
------------------------------------------------------------------------- */

void CrossingFinder::consider_fans(const double *x, Pair fans)
{
  const Surface surfaces[2] = {near_.surface(fans.first), near_.surface(fans.second)};
  if (!is_here(near_.is_owned(fans.first), near_.is_owned(fans.second), surfaces[0], surfaces[1]))
    return;
  const NumberLists &all = near_.fans().triangles;
  const Pair triangles{all.number[all.begin[fans.first]], all.number[all.begin[fans.second]]};
  const bool own = surfaces[0] == surfaces[1];
  if (own && scene_.fans_tested && !scene_.fans_tested(triangles)) return;
  Listed listed{fans, 0, {}, true, true};
  try_fan_lines(listed);
  if (listed.gap > reach_) return;
  if (!own && !scene_.tested(triangles)) return;
  if (listed.gap > 0)
    push_back_tightly(listed_, listed);
  else
    split(x, fans, reach_);
}

/* ----------------------------------------------------------------------
   Those of both normals and that between the centres, until one is good enough.
------------------------------------------------------------------------- */

void CrossingFinder::try_fan_lines(Listed &listed) const
{
  const auto [first, second] = listed.pair;
  const Normal &one = normal_[first], &other = normal_[second];
  const HeldBodies &held = near_.held();
  keep_line(listed, one.line, one.along, held.along(second, one.line));
  if (listed.gap > WIDE * reach_) return;
  keep_line(listed, other.line, held.along(first, other.line), other.along);
  if (listed.gap > WIDE * reach_) return;
  const Line between = unit(held.centre(first) - held.centre(second));
  keep_line(listed, between, held.along(first, between), held.along(second, between));
}

/* ----------------------------------------------------------------------
   keeps a line along which the two are further apart
------------------------------------------------------------------------- */

void CrossingFinder::keep_line(Listed &listed, Line line, Bounds first, Bounds second)
{
  const double beyond = first.lowest - second.highest, back = second.lowest - first.highest;
  if (std::max(beyond, back) <= listed.gap) return;
  listed.gap = rounded_down(std::max(beyond, back));
  listed.line = beyond > back ? line : -line;
}

void CrossingFinder::try_line(Listed &listed, const double *x, Line line) const
{
  keep_line(listed, line, span(x, corners(listed.pair.first, false), line),
            span(x, corners(listed.pair.second, false), line));
}

/* ----------------------------------------------------------------------
   lists pairs of triangles of two fans, unless they are beyond reach
------------------------------------------------------------------------- */

void CrossingFinder::split(const double *x, Pair fans, double reach)
{
  const NumberLists &all = near_.fans().triangles;
  find_spheres(x, fans.second);
  for (int n = all.begin[fans.first]; n < all.begin[fans.first + 1]; ++n) {
    const int triangle = all.number[n];
    const Sphere own = sphere_around(x, (*scene_.triangles)[triangle]);
    for (const Sphere &sphere : spheres_) {
      const PlainVector apart = own.centre - sphere.centre;
      const double far = reach + own.radius + sphere.radius;
      if (dot(apart, apart) <= far * far) consider(x, {triangle, sphere.triangle}, reach);
    }
  }
}

void CrossingFinder::find_spheres(const double *x, int fan)
{
  const NumberLists &all = near_.fans().triangles;
  spheres_.clear();
  for (int n = all.begin[fan]; n < all.begin[fan + 1]; ++n) {
    spheres_.push_back(sphere_around(x, (*scene_.triangles)[all.number[n]]));
    spheres_.back().triangle = all.number[n];
  }
}

void CrossingFinder::consider(const double *x, Pair pair, double reach)
{
  const Triangle &first = (*scene_.triangles)[pair.first],
                 &second = (*scene_.triangles)[pair.second];
  if (!is_here(is_owned(pair.first), is_owned(pair.second), first.surface, second.surface)) return;
  if (first.surface == second.surface && (share_corner(first, second) || !scene_.tested(pair)))
    return;
  Listed listed{pair, UNKNOWN, {}, false, false};
  const PlainVector between = sphere_around(x, first).centre - sphere_around(x, second).centre;
  for (const PlainVector &line : {between, twice_area(x, first), twice_area(x, second)}) {
    try_line(listed, x, unit(line));
    if (listed.gap > reach) return;
    if (listed.gap > WIDE * reach) break;
  }
  if (listed.gap <= 0) try_line(listed, x, unit(line_between(places(x, first), places(x, second))));
  if (listed.gap > reach) return;
  listed.apart = listed.gap > 0;
  push_back_tightly(listed_, listed);
}

/* ----------------------------------------------------------------------
   Two ranks see a pair of which each owns a side. Of different surfaces the lower number has it.
------------------------------------------------------------------------- */

bool CrossingFinder::is_here(bool first_owned, bool second_owned, Surface first, Surface second)
{
  if (!first_owned && !second_owned) return false;
  if (first_owned && second_owned) return true;
  return first == second || (first < second) == first_owned;
}

std::size_t CrossingFinder::bytes() const
{
  return start_.capacity() * sizeof(double) + near_.bytes() + motion_.bytes() +
         normal_.capacity() * sizeof(Normal) + spheres_.capacity() * sizeof(Sphere) +
         listed_.capacity() * sizeof(Listed);
}

}    // namespace rbc
