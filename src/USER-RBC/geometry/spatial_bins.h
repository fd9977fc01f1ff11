#pragma once

#include "geometry/plain_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rbc {

/// Boxes of equal size that cover the points; what is outside counts to those at the rim.
class SpatialBins {
 public:
  SpatialBins(const double *x, int points, double size)
  {
    constexpr double most = 1e6;
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = std::numeric_limits<double>::max();
      hi[d] = -lo[d];
    }
    for (int n = 0; n < points; ++n)
      for (int d = 0; d < 3; ++d) {
        lo[d] = std::min(lo[d], x[3 * std::size_t(n) + d]);
        hi[d] = std::max(hi[d], x[3 * std::size_t(n) + d]);
      }
    double volume = 1;
    for (int d = 0; d < 3; ++d) volume *= std::max(hi[d] - lo[d], size);
    size_ = std::max(size, std::cbrt(volume / most));
    inverse_ = 1 / size_;
    for (int d = 0; d < 3; ++d) {
      lo_[d] = lo[d];
      count_[d] = points > 0 ? static_cast<int>((hi[d] - lo[d]) * inverse_) + 1 : 1;
    }
  }

  /// Corner of the first bin, and the largest side of the box of all bins.
  PlainVector lowest() const { return {lo_[0], lo_[1], lo_[2]}; }
  double extent() const { return size_ * std::max({count_[0], count_[1], count_[2]}); }

  int count(int d) const { return count_[d]; }
  int count() const { return count_[0] * count_[1] * count_[2]; }
  int index(int i, int j, int k) const { return i + count_[0] * (j + count_[1] * k); }
  int along(int d, double x) const
  {
    return static_cast<int>(std::min(std::max(0.0, (x - lo_[d]) * inverse_), count_[d] - 1.0));
  }
  int of(PlainVector x) const { return index(along(0, x.x), along(1, x.y), along(2, x.z)); }

  /// Calls f(first, last), the indices of neighbors along x, for a bin and half of the bins around
  /// it, so that each pair of neighbors comes once. The first row begins with the bin itself.
  template <typename Function> void visit_half(int i, int j, int k, const Function &f) const
  {
    const int last = std::min(i + 1, count_[0] - 1), first = std::max(i - 1, 0);
    f(index(i, j, k), index(last, j, k));
    if (j + 1 < count_[1]) f(index(first, j + 1, k), index(last, j + 1, k));
    if (k + 1 == count_[2]) return;
    for (int m = std::max(j - 1, 0); m <= std::min(j + 1, count_[1] - 1); ++m)
      f(index(first, m, k + 1), index(last, m, k + 1));
  }

  /// The same for all bins within a distance of a point, however many they are.
  template <typename Function>
  void visit_half_within(PlainVector x, double distance, const Function &f) const
  {
    const int i = along(0, x.x), j = along(1, x.y), k = along(2, x.z);
    for (int m = k; m <= along(2, x.z + distance); ++m) {
      const double wide = leg(distance, this->distance(2, m, x.z));
      for (int n = m == k ? j : along(1, x.y - wide); n <= along(1, x.y + wide); ++n) {
        const double along_row = leg(wide, this->distance(1, n, x.y));
        const bool own = m == k && n == j;
        f(index(own ? i : along(0, x.x - along_row), n, m), index(along(0, x.x + along_row), n, m));
      }
    }
  }

  /// Distance along a direction to the bins numbered n there; those at the rim have no end.
  double distance(int d, int n, double x) const
  {
    const double lower = n == 0 ? x : lo_[d] + n * size_;
    const double upper = n == count_[d] - 1 ? x : lo_[d] + (n + 1) * size_;
    return std::max({0.0, lower - x, x - upper});
  }

 private:
  double lo_[3], size_, inverse_;
  int count_[3];

  /// Of a right triangle with this hypotenuse.
  static double leg(double hypotenuse, double other)
  {
    return std::sqrt(std::max(0.0, hypotenuse * hypotenuse - other * other));
  }
};

/// Adds to each bin's value those of the bins around it, in boxes numbered as those of
/// SpatialBins, `count` along each direction. `scratch` is of no use afterwards.
template <typename Value>
void merge_neighbors(const int (&count)[3], std::vector<Value> &values, std::vector<Value> &scratch)
{
  for (std::size_t d = 0, stride = 1; d < 3; stride *= count[d++]) {
    scratch = values;
    for (std::size_t b = 0; b < values.size(); ++b) {
      const int place = static_cast<int>(b / stride % count[d]);
      if (place > 0) scratch[b].add(values[b - stride]);
      if (place < count[d] - 1) scratch[b].add(values[b + stride]);
    }
    values.swap(scratch);
  }
}

}    // namespace rbc
