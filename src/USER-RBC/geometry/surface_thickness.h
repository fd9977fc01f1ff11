#pragma once

#include "geometry/surface_template.h"

namespace rbc {

/// Smallest distance of two sides of a surface that face each other, of its vertices as they are:
/// of all chords that start at a vertex, go inward along its normal and end at a triangle whose
/// normal is within 30 degrees of theirs. Zero if there are none.
double surface_thickness(const SurfaceTemplate &surface);

}    // namespace rbc
