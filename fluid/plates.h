#pragma once

#include "fluid/grid.h"
#include "fluid/halo.h"
#include "fluid/mode_solver.h"
#include "fluid/spreading.h"

namespace fluid {

/// What plane k of component c is at a plate or beyond it: `factor` times another plane, 0 times on
/// the plate for the component across it. Elsewhere it is itself.
struct PlateImage {
  int plane;
  double factor;
};
PlateImage plate_image(const Grid &grid, int c, int k);

/// Extends the velocity beyond the plates by its mirror image, as image_factor() tells: without
/// slip the reflection is odd about the plate's velocity, which the fluid thus has on the plate.
/// Acts on this rank's part only; call it after the halo is filled.
void reflect_velocity(const Grid &grid, const PlateVelocities &plates, const VectorField &velocity);

/// The transpose of reflect_velocity: force spread beyond a plate is folded back onto its mirror
/// image, times the image factor. Acts on this rank's part only; call it before ghosts are
/// accumulated. `lower` and `upper` gain the force (density summed over cells) that goes straight
/// into each plate, so that grid and plates together receive all that was spread.
void fold_force(const Grid &grid, const VectorField &force, Real3 &lower, Real3 &upper);

/// A force f that was folded and then corrected to f - C_2 D f + C_4 D D f, as the velocity of
/// sheets is, has another sum than f: differences across a plate do not cancel. `lower` and `upper`
/// gain what is missing, so that grid and plates together receive the same as before. The ghosts of
/// the force must be filled. Acts on this rank's brick only.
void balance_correction(const Grid &grid, const Box &brick, KernelKind kernel,
                        const VectorField &force, Real3 &lower, Real3 &upper);

/// Source at centres of cells, spread beyond a plate, is folded back onto its image.
void fold_source(const Grid &grid, const ScalarField &source);

}    // namespace fluid
