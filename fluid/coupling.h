#pragma once

#include "field.h"
#include "grid.h"

namespace fluid {

enum class KernelKind { roma3, peskin4 };

/// Points of the immersed boundary: `index[0 .. count)` select rows of the arrays of positions, forces and
/// velocities, which hold three numbers a row.
struct Markers {
  int count = 0;
  const int *index = nullptr;
};

/// Adds the force density of the markers to `force`, with F given in force units: f(x) += F delta_h(x - X).
/// Returns the first marker (an entry of index) whose kernel leaves the stored box, or -1.
int spread(KernelKind kernel, const Grid &grid, const Markers &markers, const double *position,
           const double *applied, double factor, const VectorField &force);

/// Velocity at the markers, the transpose of spread: U = sum over x of u(x) delta_h(x - X) h^3.
/// The markers must be those of a spread that returned -1, at the same positions.
void interpolate(KernelKind kernel, const Grid &grid, const Markers &markers,
                 const double *position, const VectorField &velocity, double *interpolated);

/// How far behind the no-slip surface wanted, in cells, markers must be: the flow of a surface of markers is, to first
/// order in the spacing, that of one so much further into the fluid (see Kernel). For flow on one side; where the other
/// side is sheared by g times as much as this one it is 1 + g times as far.
double surface_offset(KernelKind kernel);

}    // namespace fluid
