#pragma once

#include "fluid/grid.h"
#include "fluid/marker_set.h"

namespace fluid {

/// Forces that are even along the normal of a closed surface move no fluid: the pressure inside
/// balances them. Markers see a flow all the same, that of the waves which the grid takes for
/// others; in the mean over all places of the surface it is this velocity, along the normal and
/// with the force, in units of the force per area times the spacing over the viscosity. Where
/// markers must not move the fluid would pass with the opposite velocity.
///
/// A fit to the sum over these waves (bench/normal_alias.py), to 5 to 13 % of its mean.
double normal_alias(KernelKind kernel, MarkerKind kind, const Real3 &normal);

}    // namespace fluid
