#include "contact/neighbor_motion.h"

#include "geometry/rounding.h"
#include "geometry/tight_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rbc {

namespace {

constexpr double NEVER = std::numeric_limits<double>::max();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

PlainVector first_place(const HeldBodies &held, int body)
{
  return held.centre(body) + held.offset(body, held.bodies().begin[body]);
}

}    // namespace

void NeighborMotion::hold(const HeldBodies &held, double near)
{
  held_ = &held;
  bins_.emplace(held.centres().data(), held.count(), near);
  resize_tightly(bin_, held.count());
  for (int b = 0; b < held.count(); ++b) bin_[b] = bins_->of(held.centre(b));
  strain_ = 0;
  widths_ = {0, 0, 0};
  if (held.count() == 0) return;
  PlainVector sum{0, 0, 0};
  for (int b = 0; b < held.count(); ++b) sum = sum + first_place(held, b);
  flow_.reset((1.0 / held.count()) * sum);
  for (int b = 0; b < held.count(); ++b) flow_.place(first_place(held, b));
}

/* ----------------------------------------------------------------------
   In coordinates y with x = (1 + A) y, where A is the flow, bodies are where they were held but for
   what A leaves of their displacements, times the inverse of 1 + A. On the way from the positions
   before, both A and what it leaves are between those there and those now.
------------------------------------------------------------------------- */

NeighborMotion::Differences NeighborMotion::differences(const double *x)
{
  fit_flow(x);
  if (!find_extents(x)) return {INFINITE, INFINITE, INFINITE};
  strain_ = std::max(strain_, flow_.norm());
  widths_.near = std::max(widths_.near, largest_width_of_neighbors(*bins_, extents_));
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

void NeighborMotion::fit_flow(const double *x)
{
  const NumberLists &bodies = held_->bodies();
  flow_.begin();
  for (int b = 0; b < held_->count(); ++b) {
    const PlainVector place = first_place(*held_, b);
    flow_.add(place, at(x, bodies.number[bodies.begin[b]]) - place);
  }
  flow_.fit();
}

/* ----------------------------------------------------------------------
   returns whether all are numbers
------------------------------------------------------------------------- */

bool NeighborMotion::find_extents(const double *x)
{
  extents_.assign(bins_->count(), Extent::of_nothing());
  resize_tightly(body_extents_, held_->count());
  const LinearFlow flow = flow_;
  double size = 0;
  for (int b = 0; b < held_->count(); ++b) {
    size += find_displacements(x, b);
    const int begin = held_->bodies().begin[b], count = held_->bodies().begin[b + 1] - begin;
    const PlainVector centre = held_->centre(b);
    const double off = held_->error(b);
    Extent left;
    for (int d = 0; d < 3; ++d) {
      const double *const moved = moved_[d].data();
      const Bounds all = bounds(0, count, [&](int n) { return moved[n]; });
      const double carried = dot(flow.row(d), centre);
      const PlainVector row = held_->part(b) * flow.row(d);
      const Bounds rest = bounds(
          0, count, [&](int n) { return moved[n] - carried - dot(row, held_->parts(begin + n)); });
      body_extents_[b].lo[d] = not_above(all.lowest - off);
      body_extents_[b].hi[d] = -not_above(-(all.highest + off));
      left.lo[d] = rest.lowest - 2 * off;
      left.hi[d] = rest.highest + 2 * off;
    }
    extents_[bin_[b]].add(left);
  }
  return size < NEVER;
}

/* ----------------------------------------------------------------------
   returns the sum of their components, without signs
------------------------------------------------------------------------- */

double NeighborMotion::find_displacements(const double *x, int body)
{
  const int begin = held_->bodies().begin[body], end = held_->bodies().begin[body + 1];
  const PlainVector centre = held_->centre(body);
  const double part = held_->part(body);
  for (auto &moved : moved_)
    if (static_cast<int>(moved.size()) < end - begin) moved.resize(end - begin);
  double size = 0;
  for (int n = begin; n < end; ++n) {
    const PlainVector moved = at(x, held_->bodies().number[n]) - centre - part * held_->parts(n);
    moved_[0][n - begin] = moved.x;
    moved_[1][n - begin] = moved.y;
    moved_[2][n - begin] = moved.z;
    size += std::abs(moved.x) + std::abs(moved.y) + std::abs(moved.z);
  }
  return size;
}

std::size_t NeighborMotion::bytes() const
{
  return 3 * moved_[0].capacity() * sizeof(double) + bin_.capacity() * sizeof(int) +
         body_extents_.capacity() * sizeof(BodyExtent) +
         (extents_.capacity() + merged_.capacity()) * sizeof(Extent);
}

}    // namespace rbc
