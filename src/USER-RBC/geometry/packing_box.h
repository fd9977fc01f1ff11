#pragma once

#include "geometry/surface_template.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rbc {

/// Box that is periodic in some directions and has walls in the others.
struct PackingBox {
  Vec3 lo, length;
  std::array<bool, 3> periodic;

  /// From the nearest wall, negative beyond it; infinite without walls.
  double clearance(const Vec3 &x) const
  {
    double least = HUGE_VAL;
    for (int d = 0; d < 3; ++d)
      if (!periodic[d]) least = std::min({least, x[d] - lo[d], lo[d] + length[d] - x[d]});
    return least;
  }
};

}    // namespace rbc
