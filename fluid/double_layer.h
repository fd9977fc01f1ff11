#pragma once

#include "fluid/field.h"
#include "fluid/spreading.h"

namespace fluid {

/// What closed surfaces add to a flow where the fluid inside them has another viscosity.
///
/// With the velocity u, the viscosity eta outside and eta_i inside, w = u outside and w = (eta_i /
/// eta) u inside obeys the equations of one viscosity,
///   -eta lap w + grad p = f + div(n m + m n)  and  div w = -n . m / eta,  m = (eta_i - eta) u
/// where the right-hand sides stand on the surface: f is the force of its membrane, n its outward
/// normal. This is the double layer of boundary integrals (Pozrikidis, Boundary integral and
/// singularity methods for linearized viscous flow, Cambridge 1992, section 5.3), spread onto the
/// grid. On the surface itself w is the mean of both sides, (eta + eta_i) / (2 eta) u.
struct DoubleLayer {
  const double *velocity;    ///< of markers, rows as in MarkerSet
  const double *strength;    ///< (eta_i / eta - 1) times area times outward normal, the same rows
};

/// Adds to `force` the force density of the layer, and to `source` its divergence. The kernels
/// reach one cell further than in spread(). Returns the first marker (an entry of index) for which
/// they leave the box `within`, or -1.
int spread(const Grid &grid, const MarkerSet &markers, const DoubleLayer &layer, double viscosity,
           const VectorField &force, const ScalarField &source, const Box &within);

}    // namespace fluid
