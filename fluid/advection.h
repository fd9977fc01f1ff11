#pragma once

#include "fluid/field.h"
#include "fluid/grid.h"

namespace fluid {

/// result += factor div(u u) on the faces of `brick`, by central differences of the divergence form
/// (Harlow & Welch, Phys. Fluids 8 (1965) 2182), which conserve momentum and kinetic energy.
/// `velocity` needs one layer of ghosts.
void add_advection(const Grid &grid, const Box &brick, const VectorField &velocity, double factor,
                   const VectorField &result);

/// Largest sum over directions of |u| / h among the faces of the brick, a face of each direction
/// taken together, and where it is; NaN where a velocity is.
struct FastestCell {
  double rate = 0;
  Index3 cell{0, 0, 0};
};
FastestCell fastest_cell(const Grid &grid, const Box &brick, const VectorField &velocity);

}    // namespace fluid
