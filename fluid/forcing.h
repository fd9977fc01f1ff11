#pragma once

#include "fluid/box.h"

namespace fluid {

/// Velocity of the two plates, along themselves.
struct PlateVelocities {
  Real3 lower{0, 0, 0};
  Real3 upper{0, 0, 0};
};

/// What drives a flow besides forces on the grid.
struct Forcing {
  PlateVelocities plates;
  Real3 body{0, 0, 0};    ///< uniform force density
  Real3 mean{0, 0, 0};    ///< mean velocity, where it is held
};

}    // namespace fluid
