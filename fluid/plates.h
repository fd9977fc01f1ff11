#pragma once

#include "fluid/grid.h"
#include "fluid/halo.h"
#include "fluid/mode_solver.h"

namespace fluid {

/// Extends the velocity beyond the plates as the odd reflection about the plate's velocity, so that it
/// takes the plate's value on the plate. Call after the halo is filled.
void reflect_velocity(const Grid &grid, const PlateVelocities &plates, const VectorField &velocity);

/// The transpose of reflect_velocity: force spread beyond a plate is folded back with the opposite sign,
/// before ghosts are added back. `lower` and `upper` gain the force (density summed over cells) that goes
/// straight into each plate, so that grid and plates together receive all that was spread.
void fold_force(const Grid &grid, const VectorField &force, Real3 &lower, Real3 &upper);

}    // namespace fluid
