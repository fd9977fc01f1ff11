#pragma once

#include "membrane/membrane_model.h"
#include "membrane/surface_viscosity.h"

namespace rbc {

/// Forces of a membrane with surface shear viscosity whose vertices at `x` move with `v`: tensions
/// 2 viscosity (D - tr D/2) from the rate of deformation D of each triangle in its plane (Evans
/// and Skalak, Mechanics and Thermodynamics of Biomembranes, 1980). The viscosity is that at the
/// rate of shear D1 - D2, the difference of D's principal values. Written to the vertices owned;
/// returns this rank's share of the power dissipated.
double viscous_forces(const SurfaceTemplate &shape, const SurfaceViscosity &viscosity,
                      const CellElements &elements, const std::vector<Vec3> &x,
                      const std::vector<Vec3> &v, std::vector<Vec3> &f);

/// Change of these forces with a small change `w` of the velocities `v`. If
/// `frozen`, the viscosity stays that at `v`.
void viscous_forces_change(const SurfaceTemplate &shape, const SurfaceViscosity &viscosity,
                           const CellElements &elements, const std::vector<Vec3> &x, const Vec3 *v,
                           bool frozen, const std::vector<Vec3> &w, std::vector<Vec3> &f);

}    // namespace rbc
