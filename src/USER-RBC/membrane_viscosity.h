#pragma once

#include "membrane_model.h"

namespace rbc {

/// Forces of a membrane with surface shear viscosity `viscosity` (force time / length), whose vertices at `x` move with
/// `v`: tensions 2 viscosity (D - tr D/2) from the rate of deformation D of each triangle in its plane (Evans and
/// Skalak, Mechanics and Thermodynamics of Biomembranes, 1980). Written to the vertices owned; returns this rank's
/// share of the power dissipated.
double viscous_forces(const SurfaceTemplate &shape, double viscosity, const CellElements &elements,
                      const std::vector<Vec3> &x, const std::vector<Vec3> &v, std::vector<Vec3> &f);

}    // namespace rbc
