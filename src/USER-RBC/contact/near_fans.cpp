#include "contact/near_fans.h"

#include "geometry/plain_vector.h"
#include "geometry/tight_vector.h"

#include <cmath>
#include <limits>

namespace rbc {

namespace {

PlainVector at(const double *x, int n)
{
  return {x[3 * std::size_t(n)], x[3 * std::size_t(n) + 1], x[3 * std::size_t(n) + 2]};
}

}    // namespace

void NearFans::Spheres::resize(std::size_t size)
{
  for (auto *numbers : {&x, &y, &z, &radius}) resize_tightly(*numbers, size + AT_ONCE);
  for (auto *numbers : {&surface, &owned}) resize_tightly(*numbers, size + AT_ONCE);
  resize_tightly(fan, size);
}

void NearFans::build(const std::vector<NearTriangles::Triangle> &triangles,
                     const std::vector<TriangleFans::Place> &places, int points, int owned,
                     bool own_surfaces)
{
  own_surfaces_ = own_surfaces;
  if (places.size() == triangles.size())
    fans_.join(triangles, places, points);
  else
    fans_.find(triangles, points);
  const int count = fans_.corners.count();
  groups_.number.clear();
  groups_.begin.assign(1, 0);
  for (int fan = 0; fan < count; ++fan) {
    const int begin = fans_.corners.begin[fan], end = fans_.corners.begin[fan + 1];
    for (int n = begin; n < end; ++n) groups_.number.push_back(fans_.corners.number[n]);
    while (groups_.number.size() % GROUP) groups_.number.push_back(fans_.corners.number[begin]);
    groups_.begin.push_back(static_cast<int>(groups_.number.size()));
  }
  owned_.assign(count, 0);
  surface_.resize(count);
  for (int fan = 0; fan < count; ++fan) {
    surface_[fan] = triangles[fans_.triangles.number[fans_.triangles.begin[fan]]].surface;
    for (int n = fans_.corners.begin[fan]; n < fans_.corners.begin[fan + 1]; ++n)
      if (fans_.corners.number[n] < owned) owned_[fan] = 1;
  }
}

void NearFans::bound(const PointArrays &corners, double reach)
{
  reach_ = reach;
  const NumberLists &lists = groups_;
  centre_.resize(3 * std::size_t(lists.count()));
  radius_.resize(lists.count());
  largest_radius_ = 0;
  for (int fan = 0; fan < lists.count(); ++fan) {
    const int begin = lists.begin[fan], end = lists.begin[fan + 1];
    PlainVector sum{0, 0, 0};
    const int count = fans_.corners.begin[fan + 1] - fans_.corners.begin[fan];
    for (int n = begin; n < begin + count; ++n) sum = sum + corners[n];
    const PlainVector centre = (1.0 / count) * sum;
    const Bounds square = bounds(begin, end, [&](int n) {
      const double dx = corners.x[n] - centre.x, dy = corners.y[n] - centre.y,
                   dz = corners.z[n] - centre.z;
      return dx * dx + dy * dy + dz * dz;
    });
    radius_[fan] = std::sqrt(square.highest);
    largest_radius_ = std::max(largest_radius_, radius_[fan]);
    centre_[3 * std::size_t(fan)] = centre.x;
    centre_[3 * std::size_t(fan) + 1] = centre.y;
    centre_[3 * std::size_t(fan) + 2] = centre.z;
  }
  find_near_owned(reach_ + 2 * largest_radius_);
}

/* ----------------------------------------------------------------------
   fans whose centres are no further from the box around those with owned corners
------------------------------------------------------------------------- */

void NearFans::find_near_owned(double distance)
{
  constexpr double never = std::numeric_limits<double>::max();
  double lo[3] = {never, never, never}, hi[3] = {-never, -never, -never};
  for (std::size_t fan = 0; fan < owned_.size(); ++fan)
    for (int d = 0; d < 3 && owned_[fan]; ++d) {
      lo[d] = std::min(lo[d], centre_[3 * fan + d]);
      hi[d] = std::max(hi[d], centre_[3 * fan + d]);
    }
  near_owned_.clear();
  for (std::size_t fan = 0; fan < owned_.size(); ++fan) {
    bool near = true;
    for (int d = 0; d < 3; ++d)
      near &= centre_[3 * fan + d] >= lo[d] - distance && centre_[3 * fan + d] <= hi[d] + distance;
    if (near) near_owned_.push_back(static_cast<int>(fan));
  }
}

void NearFans::sort(const SpatialBins &bins)
{
  const std::size_t count = near_owned_.size();
  bin_begin_.assign(bins.count() + 1, 0);
  resize_tightly(bin_of_, count);
  for (std::size_t n = 0; n < count; ++n) {
    bin_of_[n] = bins.of(at(centre_.data(), near_owned_[n]));
    ++bin_begin_[bin_of_[n] + 1];
  }
  for (int b = 0; b < bins.count(); ++b) bin_begin_[b + 1] += bin_begin_[b];
  next_.assign(bin_begin_.begin(), bin_begin_.end() - 1);
  spheres_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const int fan = near_owned_[n], place = next_[bin_of_[n]]++;
    const PlainVector centre = at(centre_.data(), fan);
    spheres_.x[place] = centre.x;
    spheres_.y[place] = centre.y;
    spheres_.z[place] = centre.z;
    spheres_.radius[place] = radius_[fan];
    spheres_.surface[place] = surface_[fan];
    spheres_.owned[place] = is_owned(fan) ? 1 : 0;
    spheres_.fan[place] = fan;
  }
}

std::size_t NearFans::bytes() const
{
  std::size_t integers = 0;
  for (const auto *numbers : {&near_owned_, &bin_of_, &bin_begin_, &next_})
    integers += numbers->capacity();
  return fans_.bytes() + groups_.bytes() + integers * sizeof(int) + owned_.capacity() +
         surface_.capacity() * sizeof(Surface) +
         (centre_.capacity() + radius_.capacity()) * sizeof(double) +
         spheres_.x.capacity() * (4 * sizeof(double) + 2 * sizeof(std::int64_t) + sizeof(int));
}

}    // namespace rbc
