#pragma once

#include "contact/displacement_extents.h"
#include "contact/held_bodies.h"
#include "contact/linear_flow.h"
#include "geometry/spatial_bins.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace rbc {

/// How much bodies of a few points each have come nearer to each other. As RelativeMotion, but
/// closer: for bodies instead of points, for pairs of neighboring bins instead of blocks, and
/// without the linear flow that all of them follow, in which bodies that are apart stay apart.
class NeighborMotion {
 public:
  /// From now on displacements count from where these bodies, which must stay, are held. They are
  /// neighbors where their centres are nearer to each other than `near`.
  void hold(const HeldBodies &bodies, double near);

  /// Bounds of how much any points of two bodies have moved relative to each other on straight
  /// lines to the positions `x`, by way of those for which it was called since hold(). They are
  /// for coordinates that follow a linear flow whose norm() is below 0.5; bodies that touch do so
  /// in these, too. Infinite if a position is not a number.
  struct Differences {
    double near;     ///< of neighbors
    double wider;    ///< of bodies nearer to each other than twice that
    double all;      ///< of any two
  };
  Differences differences(const double *x);

  /// Between which bounds the displacements of a body were along a line, when last asked for.
  Bounds along(int body, PlainVector line) const
  {
    const double axis[3] = {line.x, line.y, line.z};
    const BodyExtent &extent = body_extents_[body];
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
  using Extent = DisplacementExtent;

  /// Of one body, in single precision, rounded outward: there are many.
  struct BodyExtent {
    float lo[3], hi[3];
  };

  std::optional<SpatialBins> bins_;
  const HeldBodies *held_ = nullptr;
  std::vector<int> bin_;            ///< of each body
  std::vector<double> moved_[3];    ///< of the points of a body
  std::vector<BodyExtent> body_extents_;
  std::vector<Extent> extents_, merged_;    ///< extents_: of each bin, less flow_
  LinearFlow flow_;
  double strain_ = 0;       ///< norm of the flow, the largest since hold()
  Differences widths_{};    ///< likewise, of what the flow leaves

  void fit_flow(const double *x);
  bool find_extents(const double *x);
  double find_displacements(const double *x, int body);
};

}    // namespace rbc
