#pragma once

#include "fluid/grid.h"
#include "fluid/kernel.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace fluid {

/// Kernel weights of one marker in one direction, for points on faces and on centres.
template <typename Kernel> struct Weights {
  int first_face, first_centre;
  Eigen::Array4d face, centre;

  Weights(double x, double origin, double inverse_spacing)
  {
    const double s = (x - origin) * inverse_spacing;
    first_face = Kernel::weights(s, face.data());
    first_centre = Kernel::weights(s - 0.5, centre.data());
  }

  /// The kernel stays inside lo <= index < hi, padded rows of four included where `padded`.
  bool inside(int lo, int hi, bool padded) const
  {
    const int width = padded ? 4 : Kernel::width;
    return std::min(first_face, first_centre) >= lo &&
           std::max(first_face, first_centre) + width <= hi;
  }
};

inline Real3 inverse(const Real3 &spacing)
{
  return {1 / spacing[0], 1 / spacing[1], 1 / spacing[2]};
}

/// The position is a number and so near the grid that indices are integers.
inline bool near(const double *x, const Grid &grid, const Real3 &inverse_spacing)
{
  for (int d = 0; d < 3; ++d)
    if (!(std::abs((x[d] - grid.origin[d]) * inverse_spacing[d]) < 1e9)) return false;
  return true;
}

}    // namespace fluid
