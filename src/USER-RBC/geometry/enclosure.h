#pragma once

#include "geometry/surface_template.h"

namespace rbc {

/// A part of space that cells must stay in.
class Enclosure {
 public:
  virtual ~Enclosure() = default;

  virtual bool contains(const Vec3 &x) const = 0;

  /// Unit normal, pointing inward, of the boundary within `distance` of a point inside; 0 if it is
  /// not known.
  virtual Vec3 inward(const Vec3 &x, double distance) const = 0;

  struct Excess {
    double depth = 0;
    Vec3 inward = Vec3::Zero();
  };

  /// By how much x sticks out, seen from a point inside.
  Excess excess(const Vec3 &from, const Vec3 &x) const
  {
    if (contains(x)) return {};
    constexpr int halvings = 12;
    double in = 0, out = 1;
    for (int n = 0; n < halvings; ++n) {
      const double middle = (in + out) / 2;
      (contains(from + middle * (x - from)) ? in : out) = middle;
    }
    const Vec3 last = from + in * (x - from);
    Vec3 normal = inward(last, 2 * (out - in) * (x - from).norm());
    if (normal.isZero()) normal = (from - x).normalized();
    return {std::max(0.0, normal.dot(last - x)), normal};
  }
};

}    // namespace rbc
