#include "contact/near_fans.h"

#include "geometry/plain_vector.h"
#include "geometry/tight_vector.h"

#include <cmath>
#include <limits>

namespace rbc {

void NearFans::Spheres::resize(std::size_t size)
{
  for (auto *numbers : {&x, &y, &z, &radius}) resize_tightly(*numbers, size + AT_ONCE);
  for (auto *numbers : {&surface, &owned}) resize_tightly(*numbers, size + AT_ONCE);
  resize_tightly(fan, size);
}

void NearFans::build(const std::vector<NearTriangles::Triangle> &triangles,
                     const std::vector<TriangleFans::Place> *places, int points, int owned,
                     bool own_surfaces)
{
  own_surfaces_ = own_surfaces;
  if (places)
    fans_.join(triangles, *places, points);
  else
    fans_.find(triangles, points);
  const int count = fans_.corners.count();
  owned_.assign(count, 0);
  resize_tightly(surface_, count);
  for (int fan = 0; fan < count; ++fan) {
    surface_[fan] = triangles[fans_.triangles.number[fans_.triangles.begin[fan]]].surface;
    for (int n = fans_.corners.begin[fan]; n < fans_.corners.begin[fan + 1]; ++n)
      if (fans_.corners.number[n] < owned) owned_[fan] = 1;
  }
}

void NearFans::hold(const double *x, double reach)
{
  reach_ = reach;
  held_.hold(x, fans_.corners);
  find_near_owned(reach_ + 2 * held_.largest_radius());
}

/* ----------------------------------------------------------------------
   fans whose centres are no further from the box around those with owned corners
------------------------------------------------------------------------- */

void NearFans::find_near_owned(double distance)
{
  constexpr double never = std::numeric_limits<double>::max();
  const std::vector<double> &centre = held_.centres();
  double lo[3] = {never, never, never}, hi[3] = {-never, -never, -never};
  for (std::size_t fan = 0; fan < owned_.size(); ++fan)
    for (int d = 0; d < 3 && owned_[fan]; ++d) {
      lo[d] = std::min(lo[d], centre[3 * fan + d]);
      hi[d] = std::max(hi[d], centre[3 * fan + d]);
    }
  near_owned_.clear();
  for (std::size_t fan = 0; fan < owned_.size(); ++fan) {
    bool near = true;
    for (int d = 0; d < 3; ++d)
      near &= centre[3 * fan + d] >= lo[d] - distance && centre[3 * fan + d] <= hi[d] + distance;
    if (near) near_owned_.push_back(static_cast<int>(fan));
  }
}

void NearFans::sort(const SpatialBins &bins)
{
  const std::size_t count = near_owned_.size();
  bin_begin_.assign(bins.count() + 1, 0);
  resize_tightly(bin_of_, count);
  for (std::size_t n = 0; n < count; ++n) {
    bin_of_[n] = bins.of(held_.centre(near_owned_[n]));
    ++bin_begin_[bin_of_[n] + 1];
  }
  for (int b = 0; b < bins.count(); ++b) bin_begin_[b + 1] += bin_begin_[b];
  next_.assign(bin_begin_.begin(), bin_begin_.end() - 1);
  spheres_.resize(count);
  spheres_.origin = bins.lowest();
  const double error =
      8 * std::numeric_limits<float>::epsilon() * (bins.extent() + reach_);    // of a distance
  for (std::size_t n = 0; n < count; ++n) {
    const int fan = near_owned_[n], place = next_[bin_of_[n]]++;
    const PlainVector centre = held_.centre(fan) - spheres_.origin;
    spheres_.x[place] = static_cast<float>(centre.x);
    spheres_.y[place] = static_cast<float>(centre.y);
    spheres_.z[place] = static_cast<float>(centre.z);
    spheres_.radius[place] = static_cast<float>(held_.radius(fan) + error);
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
  return fans_.bytes() + held_.bytes() + integers * sizeof(int) + owned_.capacity() +
         surface_.capacity() * sizeof(Surface) +
         spheres_.x.capacity() * (4 * sizeof(float) + 2 * sizeof(std::int32_t) + sizeof(int));
}

}    // namespace rbc
