#pragma once

#include "fluid/grid.h"

#include <vector>

namespace fluid {

/// The three layouts of a distributed Fourier transform: each has one direction whole on every
/// rank. `real_x` holds grid values; `x`, `y` and `z` hold modes of the real-to-complex transform,
/// of which there are cells[0]/2 + 1 in x.
struct Pencils {
  std::vector<Box> real_x, x, y, z;
};

/// The pencils (or slabs, where the bricks allow it) to which the fewest values have to be moved.
Pencils choose_pencils(const Grid &grid, const std::vector<Box> &bricks);

}    // namespace fluid
