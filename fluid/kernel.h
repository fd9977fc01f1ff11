#pragma once

#include <cmath>

namespace fluid {

// Regularised delta functions of one direction. `weights(s, w)` takes a position s in units of the
// spacing, writes the weights of the `width` grid points first, first + 1, ... and returns `first`.
// Weights are padded with zeros to four, so that a row of points is always one SIMD register. They
// are written `apart` numbers from each other, so that those of many markers are found at once.
//
// A surface of markers that does not slip at the markers is, for the flow beside it, one that does
// not slip a part of the spacing further into the fluid. For a plane in a shear flow on one side of
// it that part is half the mean distance of two points, both spread by the kernel of the same
// marker; `surface_offset` is its mean over the marker's places.
//
// The corrections remove this error for surfaces with fluid on both sides, see sheet_correction().
// The second is the variance of the weights, their place relative to the marker taken at random.
// With the fourth a large sphere turns under its tractions as it should.

/// Four-point kernel of Peskin, Acta Numerica 11 (2002) 479, equations 6.27-6.28.
struct Peskin4 {
  static constexpr int width = 4;
  static constexpr double surface_offset = 0.3810;
  static constexpr double second_correction = 0.524, fourth_correction = 0.655;

  [[gnu::always_inline]] static int weights(double s, double *w, int apart = 1)
  {
    const double below = std::floor(s), r = s - below;
    const double root = std::sqrt(1 + 4 * r * (1 - r));
    w[0] = (3 - 2 * r - root) / 8;
    w[apart] = (3 - 2 * r + root) / 8;
    w[2 * apart] = (1 + 2 * r + root) / 8;
    w[3 * apart] = (1 + 2 * r - root) / 8;
    return static_cast<int>(below) - 1;
  }
};

/// Three-point kernel of Roma, Peskin & Berger, J. Comput. Phys. 153 (1999) 509, equation 22.
struct Roma3 {
  static constexpr int width = 3;
  static constexpr double surface_offset = 0.2662;
  static constexpr double second_correction = 0.30, fourth_correction = 0.2065;

  [[gnu::always_inline]] static int weights(double s, double *w, int apart = 1)
  {
    const double nearest = std::floor(s + 0.5), r = s - nearest;
    const double root = std::sqrt(1 - 3 * r * r);
    w[0] = (2 - 3 * r - root) * (1.0 / 6);
    w[apart] = (1 + root) * (1.0 / 3);
    w[2 * apart] = (2 + 3 * r - root) * (1.0 / 6);
    w[3 * apart] = 0;
    return static_cast<int>(nearest) - 1;
  }
};

}    // namespace fluid
