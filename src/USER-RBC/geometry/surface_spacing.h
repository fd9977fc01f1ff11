#pragma once

#include "geometry/point_bins.h"

#include <vector>

namespace rbc {

/// How far apart the points are that make up a surface: for each point the distance to the nearest
/// one across the direction of its nearest neighbor. On a lattice this is its spacing, of points in
/// lines that of the lines. Points of other ranks come in as they arrive: all points are offered
/// twice, those held here, too.
class SurfaceSpacing {
 public:
  /// Neighbors count up to a distance of `reach`.
  SurfaceSpacing(const PackingBox &box, const std::vector<Vec3> &points, double reach);

  /// The first time, for the direction of the nearest neighbor.
  void offer_neighbor(const Vec3 &x);

  /// The second time, for the nearest across.
  void offer_across(const Vec3 &x);

  int points() const { return static_cast<int>(to_neighbor_.size()); }

  /// Of a point; `reach` if it is alone, negative if it lies in a line that is.
  double spacing(int point) const;

 private:
  double reach_;
  PointBins bins_;
  std::vector<Vec3> to_neighbor_;
  std::vector<double> neighbor_, across_;    // squares of distances
};

}    // namespace rbc
