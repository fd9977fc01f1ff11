#pragma once

#include "geometry/surface_template.h"

#include <vector>

namespace rbc {

/// For each vertex the triangles, in rising order, that have a corner no further from it than
/// `distance` along edges of the shape at rest.
std::vector<std::vector<int>> surface_patches(const SurfaceTemplate &surface, double distance);

}    // namespace rbc
