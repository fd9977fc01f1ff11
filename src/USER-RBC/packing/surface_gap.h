#pragma once

#include "packing/rigid_cell.h"

namespace rbc {

/// Least distance of the surfaces of two cells, exact up to `reach`, beyond which it is `reach`; 0
/// if they intersect.
double surface_gap(const RigidCell &a, const RigidCell &b, double reach);

/// Of a point from the surface of a cell, likewise; 0 inside.
double surface_gap(const Vec3 &point, const RigidCell &cell, double reach);

}    // namespace rbc
