#pragma once

#include "fluid/field.h"
#include "fluid/grid.h"

namespace fluid {

enum class KernelKind { roma3, peskin4 };

/// Points of the immersed boundary: `index[0 .. count)` select rows of the arrays of positions, forces and
/// velocities, which hold three numbers a row.
struct Markers {
  int count = 0;
  const int *index = nullptr;
};

/// Adds the force density of the markers to `force`, with F given in force units: f(x) += F delta_h(x - X).
/// Returns the first marker (an entry of index) whose kernel leaves the box `within`, or -1.
int spread(KernelKind kernel, const Grid &grid, const Markers &markers, const double *position,
           const double *applied, double factor, const VectorField &force, const Box &within);

/// Within all that is stored.
inline int spread(KernelKind kernel, const Grid &grid, const Markers &markers,
                  const double *position, const double *applied, double factor,
                  const VectorField &force)
{
  return spread(kernel, grid, markers, position, applied, factor, force, force.box());
}

/// Velocity at the markers, the transpose of spread: U = sum over x of u(x) delta_h(x - X) h^3.
/// The markers must be those of a spread that returned -1, at the same positions.
void interpolate(KernelKind kernel, const Grid &grid, const Markers &markers,
                 const double *position, const VectorField &velocity, double *interpolated);

/// How far behind the no-slip surface wanted, in cells, markers must be: the flow of a surface of markers is, to first
/// order in the spacing, that of one so much further into the fluid (see Kernel). For flow on one side; where the other
/// side is sheared by g times as much as this one it is 1 + g times as far.
double surface_offset(KernelKind kernel);

/// Square of a length, in cells, such that u - sharpening d2u/dn2 is the velocity of a sheet of markers in the flow u that
/// their forces cause. That flow has a kink at the sheet, normal n, of the tangential traction over the viscosity, which
/// spreading rounds off: interpolated alone, u lags behind by surface_offset times it, and the sheet acts that much thicker
/// on both sides. A local correction as those of regularised kernels in boundary integrals: Beale & Lai, SIAM J. Numer.
/// Anal. 38 (2001) 1902; Tlupova & Beale, J. Comput. Phys. 386 (2019) 568.
double sharpening(KernelKind kernel);

}    // namespace fluid
