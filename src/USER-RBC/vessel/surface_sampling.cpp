#include "vessel/surface_sampling.h"

#include "geometry/point_bins.h"

#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace rbc {

namespace {

// lengths in spacings
constexpr double grid_spacing = 0.4;
constexpr double crossing_tolerance = 5e-4;
constexpr double least_first_distance = 0.4, largest_first_distance = 1.2, least_share = 0.7;
constexpr double push_reach = 1.1, list_reach = 1.6;
constexpr double largest_move = 0.1;
constexpr double rough_tolerance = 1e-3, fine_tolerance = 1e-9;
constexpr double largest_depth = 0.5;    // of a point that has left the surface
constexpr double wall_distance = 0.25;
constexpr double allowed_hole = 0.9;

constexpr double push = 0.2;    // of the overlap; 1/3 is the limit of stability
constexpr int trials = 12;
constexpr double count_tolerance = 0.005;
constexpr int steps = 80, steps_per_list = 8, steps_per_projection = 4;
constexpr int filling_rounds = 5, filling_steps = 24;

}    // namespace

SurfaceSampling::SurfaceSampling(const Enclosure &enclosure, const PackingBox &box, const Vec3 &lo,
                                 const Vec3 &hi, double spacing) :
    enclosure_(enclosure),
    box_(box), lo_(lo), hi_(hi), spacing_(spacing)
{
  find_crossings();
  if (crossings_.empty()) return;
  choose();
  relax(steps);
  for (int round = 0; round < filling_rounds && fill_holes(); ++round) relax(filling_steps);
  for (std::size_t n = 0; n < points_.size(); ++n) project(static_cast<int>(n), fine_tolerance);
  measure();
}

double SurfaceSampling::grid_size(const Vec3 &lo, const Vec3 &hi, double spacing)
{
  return ((hi - lo) / (grid_spacing * spacing)).prod();
}

/* ----------------------------------------------------------------------
   of the lines of a grid with the surface
------------------------------------------------------------------------- */

void SurfaceSampling::find_crossings()
{
  std::array<long, 3> cells, nodes;
  Vec3 h;
  std::array<bool, 3> around;
  for (int d = 0; d < 3; ++d) {
    const double length = hi_[d] - lo_[d];
    around[d] = box_.periodic[d] && length > 0.999999 * box_.length[d];
    cells[d] = std::max(2L, static_cast<long>(std::ceil(length / (grid_spacing * spacing_))));
    nodes[d] = cells[d] + !around[d];
    h[d] = length / cells[d];
  }
  const auto place = [&](long i, long j, long k) -> Vec3 {
    return lo_ + h.cwiseProduct(Vec3(i, j, k));
  };
  const std::size_t row = nodes[0], layer = row * nodes[1];
  std::vector<char> first, below, here(layer);
  const auto cross = [&](bool a, bool b, const Vec3 &x, int d) {
    if (a == b) return;
    const Vec3 y = x + h[d] * Vec3::Unit(d);
    const double cell_area = h.prod() / h[d];
    add_crossing(a ? x : y, a ? y : x, crossing_tolerance * spacing_, d, cell_area);
  };
  const long planes = nodes[2] + around[2];
  for (long k = 0; k < planes; ++k) {
    if (k == nodes[2])
      here = first;
    else
      for (long j = 0; j < nodes[1]; ++j)
        for (long i = 0; i < nodes[0]; ++i) here[i + row * j] = enclosure_.contains(place(i, j, k));
    if (k > 0)
      for (long j = 0; j < nodes[1]; ++j)
        for (long i = 0; i < nodes[0]; ++i)
          cross(below[i + row * j], here[i + row * j], place(i, j, k - 1), 2);
    if (k < nodes[2])
      for (long j = 0; j < nodes[1]; ++j)
        for (long i = 0; i < nodes[0]; ++i) {
          const char side = here[i + row * j];
          if (i + 1 < nodes[0] || around[0])
            cross(side, here[(i + 1) % nodes[0] + row * j], place(i, j, k), 0);
          if (j + 1 < nodes[1] || around[1])
            cross(side, here[i + row * ((j + 1) % nodes[1])], place(i, j, k), 1);
        }
    if (k == 0) first = here;
    below = here;
  }
}

/// A line across a face of the grid stands for a part of the surface as large as the face seen
/// along its normal.
void SurfaceSampling::add_crossing(Vec3 in, Vec3 out, double tolerance, int direction,
                                   double cell_area)
{
  cut(in, out, tolerance);
  const Vec3 normal = outward(in, (out - in).normalized(), tolerance);
  area_ += std::abs(normal[direction]) * cell_area;
  crossings_.push_back({in, normal});
}

/// Near x, which is on the surface or just inside, seen from a little further inside.
Vec3 SurfaceSampling::outward(const Vec3 &x, const Vec3 &guess, double tolerance) const
{
  const Vec3 normal = -enclosure_.inward(x - tolerance * guess, 3 * tolerance);
  return normal.isZero() ? guess : normal;
}

/* ----------------------------------------------------------------------
   as many as the lattice would have
------------------------------------------------------------------------- */

void SurfaceSampling::choose()
{
  const double wanted = area_ / (std::sqrt(3.0) / 2 * spacing_ * spacing_);
  double low = least_first_distance * spacing_, high = largest_first_distance * spacing_;
  for (int trial = 0; trial < trials; ++trial) {
    const double distance = (low + high) / 2;
    choose(distance);
    const double count = static_cast<double>(points_.size());
    if (std::abs(count - wanted) < count_tolerance * wanted) break;
    (count > wanted ? low : high) = distance;
  }
}

/// In random order, all that are not too near to one chosen before.
void SurfaceSampling::choose(double distance)
{
  points_.clear();
  normals_.clear();
  std::mt19937_64 random(1);
  std::vector<int> order(crossings_.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t n = order.size() - 1; n > 0; --n) std::swap(order[n], order[random() % (n + 1)]);

  PointBins chosen(box_, distance);
  for (const int c : order) {
    const Crossing &crossing = crossings_[c];
    bool free = true;
    // not all alike, or else the grid would show on planes
    const double own =
        (least_share + (1 - least_share) * std::ldexp(random() >> 11, -53)) * distance;
    chosen.visit(crossing.place, own, [&](int n, const Vec3 &) {
      free = free && normals_[n].dot(crossing.normal) < 0;    // the other side of a thin wall
    });
    if (!free) continue;
    chosen.add(crossing.place);
    points_.push_back(crossing.place);
    normals_.push_back(crossing.normal);
  }
}

/* ---------------------------------------------------------------------- */

void SurfaceSampling::relax(int steps)
{
  anchors_ = points_;
  for (int step = 0; step < steps; ++step) {
    if (step % steps_per_list == 0) find_neighbors();
    push_apart();
    if ((step + 1) % steps_per_projection == 0 || step + 1 == steps)
      for (std::size_t n = 0; n < points_.size(); ++n)
        project(static_cast<int>(n), rough_tolerance);
  }
}

void SurfaceSampling::find_neighbors()
{
  const double reach = list_reach * spacing_;
  PointBins bins(box_, reach);
  for (const Vec3 &point : points_) bins.add(point);
  neighbors_.resize(points_.size());
  for (std::size_t n = 0; n < points_.size(); ++n) {
    neighbors_[n].clear();
    bins.visit(points_[n], reach, [&](int m, const Vec3 &image) {
      if ((image - points_[n]).isZero() || normals_[m].dot(normals_[n]) < 0) return;
      neighbors_[n].emplace_back(m, image - points_[m]);
    });
  }
}

/// Soft discs.
void SurfaceSampling::push_apart()
{
  const double reach = push_reach * spacing_;
  std::vector<Vec3> moved(points_.size());
  for (std::size_t n = 0; n < points_.size(); ++n) {
    Vec3 force = Vec3::Zero();
    for (const auto &[m, shift] : neighbors_[n]) {
      const Vec3 arm = points_[n] - points_[m] - shift;
      const double distance = arm.norm();
      if (distance < reach && distance > 0) force += (reach / distance - 1) * arm;
    }
    force -= normals_[n].dot(force) * normals_[n];
    const double size = push * force.norm(), most = largest_move * spacing_;
    moved[n] = points_[n] + (size > most ? push * most / size : push) * force;
    keep_in_box(moved[n]);
  }
  points_ = std::move(moved);
}

void SurfaceSampling::keep_in_box(Vec3 &x) const
{
  const double distance = wall_distance * spacing_;
  for (int d = 0; d < 3; ++d)
    if (!box_.periodic[d])
      x[d] = std::clamp(x[d], box_.lo[d] + distance, box_.lo[d] + box_.length[d] - distance);
}

/* ----------------------------------------------------------------------
   moves a point onto the surface along the last normal known. Past an edge there is no surface that
   way; then the point moves towards the inside of where it was before.
------------------------------------------------------------------------- */

void SurfaceSampling::project(int n, double tolerance)
{
  const Vec3 start = points_[n];
  const double fine = tolerance * spacing_;
  const bool inside = enclosure_.contains(start);
  Vec3 other = start;
  for (double far = fine; far < largest_depth * spacing_; far *= 3) {
    other = start + (inside ? far : -far) * normals_[n];
    if (enclosure_.contains(other) != inside) break;
  }
  if (enclosure_.contains(other) == inside) {
    other = anchors_[n] - largest_depth * spacing_ * normals_[n];
    if (inside || !enclosure_.contains(other)) {
      points_[n] = anchors_[n];
      return;
    }
  }
  Vec3 in = inside ? start : other, out = inside ? other : start;
  cut(in, out, fine);
  points_[n] = anchors_[n] = in;
  normals_[n] = outward(in, (out - in).normalized(), fine);
}

/// Halves the line between two points until they are that near to each other.
void SurfaceSampling::cut(Vec3 &in, Vec3 &out, double tolerance) const
{
  while ((out - in).norm() > tolerance) {
    const Vec3 middle = (in + out) / 2;
    (enclosure_.contains(middle) ? in : out) = middle;
  }
}

/* ----------------------------------------------------------------------
   a point in each place that is too far from all others
------------------------------------------------------------------------- */

bool SurfaceSampling::fill_holes()
{
  const double distance = allowed_hole * spacing_;
  PointBins bins(box_, distance);
  for (const Vec3 &point : points_) bins.add(point);
  const std::size_t before = points_.size();
  for (const Crossing &crossing : crossings_) {
    Vec3 place = crossing.place;
    keep_in_box(place);
    if (place != crossing.place) continue;
    bool covered = false;
    bins.visit(place, distance, [&](int n, const Vec3 &) {
      covered = covered || normals_[n].dot(crossing.normal) >= 0;
    });
    if (covered) continue;
    bins.add(place);
    points_.push_back(place);
    normals_.push_back(crossing.normal);
  }
  return points_.size() > before;
}

void SurfaceSampling::measure()
{
  const double far = 1.5 * spacing_;    // nothing is further apart, after holes were filled
  PointBins bins(box_, spacing_);
  for (const Vec3 &point : points_) bins.add(point);
  const auto nearest = [&](const Vec3 &x, const Vec3 &normal, int itself) {
    double least = far;
    bins.visit(x, far, [&](int n, const Vec3 &image) {
      if (n != itself && normals_[n].dot(normal) >= 0) least = std::min(least, (image - x).norm());
    });
    return least;
  };
  least_distance_ = far;
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const double distance = nearest(points_[n], normals_[n], static_cast<int>(n));
    mean_distance_ += distance / points_.size();
    least_distance_ = std::min(least_distance_, distance);
  }
  for (const Crossing &crossing : crossings_)
    largest_hole_ = std::max(largest_hole_, nearest(crossing.place, crossing.normal, -1));
}

}    // namespace rbc
