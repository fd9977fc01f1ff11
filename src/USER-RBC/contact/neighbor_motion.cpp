#include "contact/neighbor_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rbc {

namespace {

constexpr double NEVER = std::numeric_limits<double>::max();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

PlainVector at(const std::vector<double> &x, int n)
{
  return {x[3 * std::size_t(n)], x[3 * std::size_t(n) + 1], x[3 * std::size_t(n) + 2]};
}

}    // namespace

NeighborMotion::Extent NeighborMotion::Extent::of_nothing()
{
  return {{NEVER, NEVER, NEVER}, {-NEVER, -NEVER, -NEVER}};
}

void NeighborMotion::Extent::add(const Extent &other)
{
  for (int d = 0; d < 3; ++d) {
    lo[d] = std::min(lo[d], other.lo[d]);
    hi[d] = std::max(hi[d], other.hi[d]);
  }
}

double NeighborMotion::Extent::width() const
{
  if (empty()) return 0;
  double sum = 0;
  for (int d = 0; d < 3; ++d) sum += (hi[d] - lo[d]) * (hi[d] - lo[d]);
  return std::sqrt(sum);
}

void NeighborMotion::hold(const PointArrays &positions, const NumberLists &bodies,
                          const std::vector<double> &centres, double near)
{
  held_ = &positions;
  bodies_ = &bodies;
  bins_.emplace(centres.data(), bodies.count(), near);
  bin_.resize(bodies.count());
  for (int b = 0; b < bodies.count(); ++b) bin_[b] = bins_->of(at(centres, b));
  strain_ = 0;
  widths_ = {0, 0, 0};
  if (bodies.count() == 0) return;
  PlainVector sum{0, 0, 0};
  for (int b = 0; b < bodies.count(); ++b) sum = sum + positions[bodies.begin[b]];
  flow_.reset((1.0 / bodies.count()) * sum);
  for (int b = 0; b < bodies.count(); ++b) flow_.place(positions[bodies.begin[b]]);
}

/* ----------------------------------------------------------------------
   In coordinates y with x = (1 + A) y, where A is the flow, bodies are where they were held but for
   what A leaves of their displacements, times the inverse of 1 + A. On the way from the positions
   before, both A and what it leaves are between those there and those now.
------------------------------------------------------------------------- */

NeighborMotion::Differences NeighborMotion::differences(const double *x)
{
  if (!find_displacements(x)) return {INFINITE, INFINITE, INFINITE};
  fit_flow();
  find_extents();
  strain_ = std::max(strain_, flow_.norm());
  widths_.near = std::max(widths_.near, width_of_neighbors());
  Extent all = Extent::of_nothing();
  for (const Extent &extent : extents_) all.add(extent);
  widths_.all = std::max(widths_.all, all.width());
  const int count[3] = {bins_->count(0), bins_->count(1), bins_->count(2)};
  merge_neighbors(count, extents_, merged_);
  merge_neighbors(count, extents_, merged_);
  for (const Extent &extent : extents_) widths_.wider = std::max(widths_.wider, extent.width());
  const double stretched = 1 / (1 - strain_);
  return {stretched * widths_.near, stretched * widths_.wider, stretched * widths_.all};
}

/* ----------------------------------------------------------------------
   returns whether all are numbers
------------------------------------------------------------------------- */

bool NeighborMotion::find_displacements(const double *x)
{
  moved_.take(x, bodies_->number);
  const double size = sum(static_cast<int>(moved_.x.size()), [this](int n) {
    moved_.x[n] -= held_->x[n];
    moved_.y[n] -= held_->y[n];
    moved_.z[n] -= held_->z[n];
    return std::abs(moved_.x[n]) + std::abs(moved_.y[n]) + std::abs(moved_.z[n]);
  });
  return size < NEVER;
}

void NeighborMotion::fit_flow()
{
  flow_.begin();
  for (int b = 0; b < bodies_->count(); ++b)
    flow_.add((*held_)[bodies_->begin[b]], moved_[bodies_->begin[b]]);
  flow_.fit();
}

void NeighborMotion::find_extents()
{
  extents_.assign(bins_->count(), Extent::of_nothing());
  body_extents_.resize(bodies_->count());
  const PointArrays &held = *held_;
  const LinearFlow flow = flow_;
  for (int b = 0; b < bodies_->count(); ++b) {
    const int begin = bodies_->begin[b], end = bodies_->begin[b + 1];
    Extent left;
    for (int d = 0; d < 3; ++d) {
      const double *const moved = (d == 0 ? moved_.x : d == 1 ? moved_.y : moved_.z).data();
      const Bounds all = bounds(begin, end, [&](int n) { return moved[n]; });
      const PlainVector row = flow.row(d);
      const Bounds rest = bounds(begin, end, [&](int n) {
        return moved[n] - (row.x * held.x[n] + row.y * held.y[n] + row.z * held.z[n]);
      });
      body_extents_[b].lo[d] = all.lowest;
      body_extents_[b].hi[d] = all.highest;
      left.lo[d] = rest.lowest;
      left.hi[d] = rest.highest;
    }
    extents_[bin_[b]].add(left);
  }
}

/* ----------------------------------------------------------------------
   each bin with each of its neighbors: closer than all of them together
------------------------------------------------------------------------- */

double NeighborMotion::width_of_neighbors() const
{
  double largest = 0;
  for (int k = 0; k < bins_->count(2); ++k)
    for (int j = 0; j < bins_->count(1); ++j)
      for (int i = 0; i < bins_->count(0); ++i) {
        const Extent &own = extents_[bins_->index(i, j, k)];
        if (own.empty()) continue;
        bins_->visit_half(i, j, k, [&](int first, int last) {
          for (int other = first; other <= last; ++other) {
            if (extents_[other].empty()) continue;
            Extent both = own;
            both.add(extents_[other]);
            largest = std::max(largest, both.width());
          }
        });
      }
  return largest;
}

std::size_t NeighborMotion::bytes() const
{
  return moved_.bytes() + bin_.capacity() * sizeof(int) +
         (body_extents_.capacity() + extents_.capacity() + merged_.capacity()) * sizeof(Extent);
}

}    // namespace rbc
