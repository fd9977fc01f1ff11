#include "contact/relative_motion.h"

#include "geometry/spatial_bins.h"

namespace rbc {

namespace {

constexpr double NEVER = std::numeric_limits<double>::max();

}    // namespace

void RelativeMotion::Extent::add(const Extent &other)
{
  for (int d = 0; d < 3; ++d) {
    lo[d] = std::min(lo[d], other.lo[d]);
    hi[d] = std::max(hi[d], other.hi[d]);
  }
}

double RelativeMotion::Extent::width() const
{
  if (lo[0] > hi[0]) return 0;    // of nothing
  double sum = 0;
  for (int d = 0; d < 3; ++d) sum += (hi[d] - lo[d]) * (hi[d] - lo[d]);
  return std::sqrt(sum);
}

void RelativeMotion::hold(const double *x, int points, double near)
{
  held_.assign(x, x + 3 * std::size_t(points));
  const SpatialBins bins(x, points, near);
  for (int d = 0; d < 3; ++d) count_[d] = bins.count(d);
  around_.assign(bins.count(), 0);
  bin_.resize(points);
  for (int n = 0; n < points; ++n)
    bin_[n] = bins.of(
        {held_[3 * std::size_t(n)], held_[3 * std::size_t(n) + 1], held_[3 * std::size_t(n) + 2]});
}

RelativeMotion::Differences RelativeMotion::differences(const double *x, const LinearFlow &flow)
{
  const std::size_t bins = std::size_t(count_[0]) * count_[1] * count_[2];
  extents_.assign(bins, {{NEVER, NEVER, NEVER}, {-NEVER, -NEVER, -NEVER}});
  const PlainVector row[3] = {flow.row(0), flow.row(1), flow.row(2)};
  bool numbers = true;
  for (std::size_t n = 0; n < bin_.size(); ++n) {
    Extent &extent = extents_[bin_[n]];
    const PlainVector held{held_[3 * n], held_[3 * n + 1], held_[3 * n + 2]};
    for (int d = 0; d < 3; ++d) {
      const double moved = x[3 * n + d] - held_[3 * n + d] - dot(row[d], held);
      numbers &= std::abs(moved) < NEVER;
      extent.lo[d] = std::min(extent.lo[d], moved);
      extent.hi[d] = std::max(extent.hi[d], moved);
    }
  }
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!numbers) return {infinite, infinite};

  Differences differences{0, 0};
  merge_neighbors(count_, extents_, merged_);
  for (std::size_t b = 0; b < bins; ++b) {
    around_[b] = extents_[b].width();
    differences.near = std::max(differences.near, around_[b]);
  }
  merge_neighbors(count_, extents_, merged_);
  for (const Extent &extent : extents_)
    differences.wider = std::max(differences.wider, extent.width());
  return differences;
}

std::size_t RelativeMotion::bytes() const
{
  return (held_.capacity() + around_.capacity()) * sizeof(double) + bin_.capacity() * sizeof(int) +
         (extents_.capacity() + merged_.capacity()) * sizeof(Extent);
}

}    // namespace rbc
