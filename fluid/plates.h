#pragma once

#include "fluid/grid.h"
#include "fluid/halo.h"
#include "fluid/mode_solver.h"

namespace fluid {

/// Extends the velocity beyond the plates by its mirror image, as image_factor() tells: without
/// slip the reflection is odd about the plate's velocity, which the fluid thus has on the plate.
/// Acts on this rank's part only; call it after the halo is filled.
void reflect_velocity(const Grid &grid, const PlateVelocities &plates, const VectorField &velocity);

/// The transpose of reflect_velocity: force spread beyond a plate is folded back onto its mirror
/// image, times the image factor. Acts on this rank's part only; call it before ghosts are
/// accumulated. `lower` and `upper` gain the force (density summed over cells) that goes straight
/// into each plate, so that grid and plates together receive all that was spread.
void fold_force(const Grid &grid, const VectorField &force, Real3 &lower, Real3 &upper);

/// The same for a source at centres of cells: beyond a plate it is folded back onto its image.
void fold_source(const Grid &grid, const ScalarField &source);

}    // namespace fluid
