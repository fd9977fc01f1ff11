#pragma once

#include "contact/displacement_extents.h"
#include "contact/held_positions.h"
#include "contact/linear_flow.h"

#include <optional>
#include <vector>

namespace rbc {

/// How differently points have moved that were near each other.
class RelativeMotion {
 public:
  /// Positions, three numbers for each point, from which displacements count.
  void hold(const double *x, int points, double near);

  PlainVector held(int point) const { return held_[point]; }

  /// Bounds of the difference of the displacements of any two points, less those of a flow that
  /// moves all of them: infinite if one is not a number.
  struct Differences {
    double near;     ///< where they were nearer than `near`
    double wider;    ///< where they were nearer than twice that
  };
  Differences differences(const double *x, const LinearFlow &flow = {});

  /// A closer bound where they were nearer than `near`, which takes longer to find.
  double closer_difference(const double *x, const LinearFlow &flow);

  /// Bound of the difference, when differences() was last asked for and finite, to any point that
  /// was nearer than `near`; 0 after hold().
  double around(int point) const { return around_[bin_[point]]; }

  std::size_t bytes() const;

 private:
  std::optional<SpatialBins> bins_;
  HeldPositions held_;
  std::vector<int> bin_;                                // of each point
  std::vector<DisplacementExtent> extents_, merged_;    // of each bin; with its neighbors
  std::vector<double> around_;                          // width of the latter

  bool find_extents(const double *x, const LinearFlow &flow);
  double error() const;
};

}    // namespace rbc
