#include "contact/relative_motion.h"

#include "geometry/tight_vector.h"

namespace rbc {

namespace {

constexpr double NEVER = std::numeric_limits<double>::max();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

}    // namespace

void RelativeMotion::hold(const double *x, int points, double near)
{
  held_.hold(x, points);
  bins_.emplace(x, points, near);
  reserve_loosely(around_, bins_->count());
  for (auto *extents : {&extents_, &merged_}) reserve_loosely(*extents, bins_->count());
  around_.assign(bins_->count(), 0);
  bin_.resize(points);
  for (int n = 0; n < points; ++n) bin_[n] = bins_->of(at(x, n));
}

RelativeMotion::Differences RelativeMotion::differences(const double *x, const LinearFlow &flow)
{
  if (!find_extents(x, flow)) return {INFINITE, INFINITE};
  Differences differences{0, 0};
  const int count[3] = {bins_->count(0), bins_->count(1), bins_->count(2)};
  merge_neighbors(count, extents_, merged_);
  for (std::size_t b = 0; b < extents_.size(); ++b) {
    around_[b] = extents_[b].width() + error();
    differences.near = std::max(differences.near, around_[b]);
  }
  merge_neighbors(count, extents_, merged_);
  for (const DisplacementExtent &extent : extents_)
    differences.wider = std::max(differences.wider, extent.width() + error());
  return differences;
}

double RelativeMotion::closer_difference(const double *x, const LinearFlow &flow)
{
  if (!find_extents(x, flow)) return INFINITE;
  return largest_width_of_neighbors(*bins_, extents_) + error();
}

/// Of the difference of two displacements, less those of a flow whose norm is below 1: either may
/// be off by twice as much as the position from which it counts.
double RelativeMotion::error() const
{
  return 4 * held_.error();
}

/* ----------------------------------------------------------------------
   returns whether all are numbers
------------------------------------------------------------------------- */

bool RelativeMotion::find_extents(const double *x, const LinearFlow &flow)
{
  extents_.assign(bins_->count(), DisplacementExtent::of_nothing());
  const PlainVector row[3] = {flow.row(0), flow.row(1), flow.row(2)};
  bool numbers = true;
  for (std::size_t n = 0; n < bin_.size(); ++n) {
    DisplacementExtent &extent = extents_[bin_[n]];
    const PlainVector held = this->held(static_cast<int>(n)), moved = at(x, n) - held;
    const double left[3] = {moved.x - dot(row[0], held), moved.y - dot(row[1], held),
                            moved.z - dot(row[2], held)};
    for (int d = 0; d < 3; ++d) {
      numbers &= std::abs(left[d]) < NEVER;
      extent.lo[d] = std::min(extent.lo[d], left[d]);
      extent.hi[d] = std::max(extent.hi[d], left[d]);
    }
  }
  return numbers;
}

std::size_t RelativeMotion::bytes() const
{
  return held_.bytes() + around_.capacity() * sizeof(double) + bin_.capacity() * sizeof(int) +
         (extents_.capacity() + merged_.capacity()) * sizeof(DisplacementExtent);
}

}    // namespace rbc
