#pragma once

#include "fluid/field.h"
#include "fluid/grid.h"
#include "fluid/marker_set.h"

namespace fluid {

/// Adds the force density of the markers to `force`, with F given in force units: f(x) += F
/// delta_h(x - X). Returns the first marker (an entry of index) whose kernel leaves the box
/// `within`, or -1.
int spread(const Grid &grid, const MarkerSet &markers, const double *applied, double factor,
           const VectorField &force, const Box &within);

/// The same with `within` = force.box(), the whole array.
inline int spread(const Grid &grid, const MarkerSet &markers, const double *applied, double factor,
                  const VectorField &force)
{
  return spread(grid, markers, applied, factor, force, force.box());
}

/// Velocity at the markers, the transpose of spread: U = sum over x of u(x) delta_h(x - X) h^3.
/// The markers must be those of a spread that returned -1, at the same positions.
void interpolate(const Grid &grid, const MarkerSet &markers, const VectorField &velocity,
                 double *interpolated);

/// Hydrodynamic thickness of a surface of markers in grid spacings: place markers this far behind
/// the no-slip surface that is wanted. To first order in the spacing their flow is that of a
/// surface so much further into the fluid (see Kernel). This holds for flow on one side; where the
/// other side is sheared by g times as much it is 1 + g times as far.
double surface_offset(KernelKind kernel);

/// Factors C_2 and C_4, of squares and fourth powers of a cell, such that u - C_2 D u + C_4 D D u
/// is the velocity of a sheet of markers in the flow u that their forces cause; D is the sum of the
/// second differences.
///
/// Kernels blur the flow twice. C_2 undoes this where the flow is smooth: it is the variance of the
/// kernel's weights. At a sheet with a tangential
/// traction the flow has a kink, which is rounded off: interpolated alone, u lags behind by
/// surface_offset times the traction over the viscosity, and the sheet acts that much thicker on
/// both sides. With C_4 this vanishes, and what is left of the error is of third order. A local
/// correction as those of regularised kernels in boundary integrals: Beale & Lai, SIAM J. Numer.
/// Anal. 38 (2001) 1902; Tlupova & Beale, J. Comput. Phys. 386 (2019) 568. See theory.rst.
struct SheetCorrection {
  double second, fourth;
};
SheetCorrection sheet_correction(KernelKind kernel);

}    // namespace fluid
