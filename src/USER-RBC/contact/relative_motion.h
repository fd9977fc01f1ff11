#pragma once

#include "contact/linear_flow.h"

#include <vector>

namespace rbc {

/// How differently points have moved that were near each other.
class RelativeMotion {
 public:
  /// Positions, three numbers for each point, from which displacements count.
  void hold(const double *x, int points, double near);

  /// Bounds of the difference of the displacements of any two points, less those of a flow that
  /// moves all of them: infinite if one is not a number.
  struct Differences {
    double near;     ///< where they were nearer than `near`
    double wider;    ///< where they were nearer than twice that
  };
  Differences differences(const double *x, const LinearFlow &flow = {});

  /// Bound of the difference, when last asked for and finite, to any point that was nearer than
  /// `near`; 0 after hold().
  double around(int point) const { return around_[bin_[point]]; }

  PlainVector held(int point) const
  {
    const double *const at = &held_[3 * std::size_t(point)];
    return {at[0], at[1], at[2]};
  }

  std::size_t bytes() const;

 private:
  /// Displacements of several points.
  struct Extent {
    double lo[3], hi[3];

    void add(const Extent &other);
    double width() const;
  };

  int count_[3] = {0, 0, 0};    // of bins
  std::vector<double> held_;
  std::vector<int> bin_;                    // of each point
  std::vector<Extent> extents_, merged_;    // of each bin; with its neighbors
  std::vector<double> around_;              // width of the latter
};

}    // namespace rbc
