#pragma once

#include "contact/number_lists.h"
#include "geometry/spatial_bins.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace rbc {

/// How much bodies of a few points each have come nearer to each other. As RelativeMotion, but
/// closer: for bodies instead of points, and for pairs of neighboring bins instead of blocks.
class NeighborMotion {
 public:
  /// From now on displacements count from `x`. Bodies are neighbors where their `centres` are
  /// nearer to each other than `near`. Both have three numbers for each point, or body. `bodies`
  /// must stay.
  void hold(const double *x, const NumberLists &bodies, const std::vector<double> &centres,
            double near);

  /// Bounds of the difference of two displacements, each of any point of a body, for the positions
  /// `x`: infinite if one is not a number.
  struct Differences {
    double near;     ///< of neighbors
    double wider;    ///< of bodies nearer to each other than twice that
    double all;      ///< of any two
  };
  Differences differences(const double *x);

  /// Bound of the difference, when last asked for, of a body and any neighbor; 0 after hold().
  double around(int body) const { return around_[bin_[body]]; }

  /// Between which bounds the displacements of a body were along a line, when last asked for.
  struct Bounds {
    double lowest, highest;
  };
  Bounds along(int body, PlainVector line) const
  {
    const double axis[3] = {line.x, line.y, line.z};
    const Extent &extent = body_extents_[body];
    Bounds bounds{0, 0};
    for (int d = 0; d < 3; ++d) {
      const double lo = axis[d] * extent.lo[d], hi = axis[d] * extent.hi[d];
      bounds.lowest += std::min(lo, hi);
      bounds.highest += std::max(lo, hi);
    }
    return bounds;
  }

  std::size_t bytes() const;

 private:
  /// Displacements of several points.
  struct Extent {
    double lo[3], hi[3];

    static Extent of_nothing();
    void add(const Extent &other);
    bool empty() const { return lo[0] > hi[0]; }
    double width() const;
  };

  std::optional<SpatialBins> bins_;
  const NumberLists *bodies_ = nullptr;
  std::vector<int> bin_;                                   ///< of each body
  std::vector<double> held_;                               ///< positions, in the order of the lists
  std::vector<double> around_;                             ///< of each bin
  std::vector<Extent> body_extents_, extents_, merged_;    ///< extents_: of each bin

  bool find_extents(const double *x);
  double find_around();
};

}    // namespace rbc
