#pragma once

#include "fluid/box.h"
#include "fluid/lanes.h"
#include "fluid/wavenumbers.h"

namespace fluid {

/// Wave vectors in x and y of the modes first, first + 1, ... of a plane: magnitude, direction, and
/// the factors from faces to centres. The mean mode counts as one of magnitude 1 along x, without
/// meaning.
struct WaveVectors {
  Lanes kappa = Lanes::Ones(), x = Lanes::Ones(), y = Lanes::Zero();
  Modes ex = Modes::constant(1), ey = Modes::constant(1);

  WaveVectors(const Wavenumbers &in_x, const Wavenumbers &in_y, const Box &modes, int first,
              int count)
  {
    for (int m = 0; m < count; ++m) {
      const int i = (first + m) % modes.extent(0), j = (first + m) / modes.extent(0);
      ex.set(m, in_x.half_shift[i]);
      ey.set(m, in_y.half_shift[j]);
      const double magnitude = std::hypot(in_x.kappa[i], in_y.kappa[j]);
      if (magnitude == 0) continue;
      kappa[m] = magnitude;
      x[m] = in_x.kappa[i] / magnitude;
      y[m] = in_y.kappa[j] / magnitude;
    }
  }
};

}    // namespace fluid
