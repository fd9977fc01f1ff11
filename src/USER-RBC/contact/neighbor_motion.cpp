#include "contact/neighbor_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rbc {

namespace {

constexpr double NEVER = std::numeric_limits<double>::max();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

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

void NeighborMotion::hold(const double *x, const NumberLists &bodies,
                          const std::vector<double> &centres, double near)
{
  bodies_ = &bodies;
  held_.resize(3 * bodies.number.size());
  for (std::size_t n = 0; n < bodies.number.size(); ++n)
    for (int d = 0; d < 3; ++d) held_[3 * n + d] = x[3 * std::size_t(bodies.number[n]) + d];
  bins_.emplace(centres.data(), bodies.count(), near);
  bin_.resize(bodies.count());
  for (std::size_t b = 0; b < bin_.size(); ++b)
    bin_[b] = bins_->of({centres[3 * b], centres[3 * b + 1], centres[3 * b + 2]});
  around_.assign(bins_->count(), 0);
}

NeighborMotion::Differences NeighborMotion::differences(const double *x)
{
  if (!find_extents(x)) return {INFINITE, INFINITE, INFINITE};
  Differences differences{find_around(), 0, 0};
  Extent all = Extent::of_nothing();
  for (const Extent &extent : extents_) all.add(extent);
  differences.all = all.width();
  const int count[3] = {bins_->count(0), bins_->count(1), bins_->count(2)};
  merge_neighbors(count, extents_, merged_);
  merge_neighbors(count, extents_, merged_);
  for (const Extent &extent : extents_)
    differences.wider = std::max(differences.wider, extent.width());
  return differences;
}

/* ----------------------------------------------------------------------
   returns whether all displacements are numbers
------------------------------------------------------------------------- */

bool NeighborMotion::find_extents(const double *x)
{
  extents_.assign(bins_->count(), Extent::of_nothing());
  body_extents_.resize(bodies_->count());
  bool numbers = true;
  for (int b = 0; b < bodies_->count(); ++b) {
    Extent extent = Extent::of_nothing();
    for (int n = bodies_->begin[b]; n < bodies_->begin[b + 1]; ++n)
      for (int d = 0; d < 3; ++d) {
        const double moved =
            x[3 * std::size_t(bodies_->number[n]) + d] - held_[3 * std::size_t(n) + d];
        numbers &= std::abs(moved) < NEVER;
        extent.lo[d] = std::min(extent.lo[d], moved);
        extent.hi[d] = std::max(extent.hi[d], moved);
      }
    body_extents_[b] = extent;
    extents_[bin_[b]].add(extent);
  }
  return numbers;
}

/* ----------------------------------------------------------------------
   each bin with each of its neighbors: closer than all of them together
------------------------------------------------------------------------- */

double NeighborMotion::find_around()
{
  std::fill(around_.begin(), around_.end(), 0.0);
  double largest = 0;
  for (int k = 0; k < bins_->count(2); ++k)
    for (int j = 0; j < bins_->count(1); ++j)
      for (int i = 0; i < bins_->count(0); ++i) {
        const int b = bins_->index(i, j, k);
        if (extents_[b].empty()) continue;
        bins_->visit_half(i, j, k, [&](int first, int last) {
          for (int other = first; other <= last; ++other) {
            if (extents_[other].empty()) continue;
            Extent both = extents_[b];
            both.add(extents_[other]);
            const double width = both.width();
            around_[b] = std::max(around_[b], width);
            around_[other] = std::max(around_[other], width);
            largest = std::max(largest, width);
          }
        });
      }
  return largest;
}

std::size_t NeighborMotion::bytes() const
{
  return (held_.capacity() + around_.capacity()) * sizeof(double) + bin_.capacity() * sizeof(int) +
         (body_extents_.capacity() + extents_.capacity() + merged_.capacity()) * sizeof(Extent);
}

}    // namespace rbc
