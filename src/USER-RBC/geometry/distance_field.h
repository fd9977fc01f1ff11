#pragma once

#include "geometry/surface_template.h"

#include <algorithm>
#include <vector>

namespace rbc {

/// Signed distance from a closed surface, negative inside: exact on the nodes of a grid, trilinear
/// in between.
class DistanceField {
 public:
  struct Sample {
    double distance;
    Vec3 gradient;
  };

  /// On a grid that holds all points nearer than `reach`.
  DistanceField(const SurfaceTemplate &surface, double reach);

  /// Beyond the grid not less than the distance, and not less than `reach`.
  Sample at(const Vec3 &x) const;

  double spacing() const { return spacing_; }

  /// Of the point deepest inside.
  double depth() const { return -*std::min_element(distance_.begin(), distance_.end()); }

 private:
  Vec3 lo_, hi_;
  double spacing_;
  int nodes_[3];
  std::vector<float> distance_;

  Sample interpolated(const Vec3 &x) const;
};

}    // namespace rbc
