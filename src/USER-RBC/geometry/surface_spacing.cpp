#include "geometry/surface_spacing.h"

#include <cmath>

namespace rbc {

namespace {

constexpr double same_share = 1e-6;       // of the reach: points nearer are one
constexpr double along_cosine = 0.75;     // directions above it do not count as across
constexpr double bins_per_reach = 2.0;    // a compromise of bins visited and points in them

}    // namespace

SurfaceSpacing::SurfaceSpacing(const PackingBox &box, const std::vector<Vec3> &points,
                               double reach) :
    reach_(reach),
    bins_(box, reach / bins_per_reach), to_neighbor_(points.size(), Vec3::Zero()),
    neighbor_(points.size(), reach * reach), across_(points.size(), reach * reach)
{
  for (const Vec3 &x : points) bins_.add(x);
}

void SurfaceSpacing::offer_neighbor(const Vec3 &x)
{
  const double least = same_share * reach_;
  bins_.visit(x, reach_, [&](int point, const Vec3 &place) {
    const Vec3 arm = x - place;
    const double square = arm.squaredNorm();
    if (square < least * least || square >= neighbor_[point]) return;
    neighbor_[point] = square;
    to_neighbor_[point] = arm;
  });
}

void SurfaceSpacing::offer_across(const Vec3 &x)
{
  const double least = same_share * reach_;
  bins_.visit(x, reach_, [&](int point, const Vec3 &place) {
    const Vec3 arm = x - place;
    const double square = arm.squaredNorm(), along = arm.dot(to_neighbor_[point]);
    if (square < least * least || square >= across_[point]) return;
    if (along * along > along_cosine * along_cosine * square * neighbor_[point]) return;
    across_[point] = square;
  });
}

double SurfaceSpacing::spacing(int point) const
{
  const double all = reach_ * reach_;
  if (neighbor_[point] >= all) return reach_;
  return across_[point] >= all ? -1 : std::sqrt(across_[point]);
}

}    // namespace rbc
