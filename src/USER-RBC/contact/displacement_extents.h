#pragma once

#include "geometry/spatial_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rbc {

/// Bounds of the displacements of several points.
struct DisplacementExtent {
  double lo[3], hi[3];

  static DisplacementExtent of_nothing()
  {
    constexpr double never = std::numeric_limits<double>::max();
    return {{never, never, never}, {-never, -never, -never}};
  }

  void add(const DisplacementExtent &other)
  {
    for (int d = 0; d < 3; ++d) {
      lo[d] = std::min(lo[d], other.lo[d]);
      hi[d] = std::max(hi[d], other.hi[d]);
    }
  }

  bool empty() const { return lo[0] > hi[0]; }

  /// Bound of the difference of any two of them.
  double width() const
  {
    if (empty()) return 0;
    double sum = 0;
    for (int d = 0; d < 3; ++d) sum += (hi[d] - lo[d]) * (hi[d] - lo[d]);
    return std::sqrt(sum);
  }
};

/// The largest width of a bin with one of its neighbors: less than that with all of them together.
inline double largest_width_of_neighbors(const SpatialBins &bins,
                                         const std::vector<DisplacementExtent> &extents)
{
  double largest = 0;
  for (int k = 0; k < bins.count(2); ++k)
    for (int j = 0; j < bins.count(1); ++j)
      for (int i = 0; i < bins.count(0); ++i) {
        const DisplacementExtent &own = extents[bins.index(i, j, k)];
        if (own.empty()) continue;
        bins.visit_half(i, j, k, [&](int first, int last) {
          for (int other = first; other <= last; ++other) {
            if (extents[other].empty()) continue;
            DisplacementExtent both = own;
            both.add(extents[other]);
            largest = std::max(largest, both.width());
          }
        });
      }
  return largest;
}

}    // namespace rbc
