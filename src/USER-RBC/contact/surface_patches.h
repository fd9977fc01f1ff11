#pragma once

#include "contact/triangle_fans.h"
#include "geometry/surface_template.h"

#include <vector>

namespace rbc {

/// For each vertex the triangles, in rising order, that have a corner no further from it than
/// `distance` along edges of the shape at rest.
std::vector<std::vector<int>> surface_patches(const SurfaceTemplate &surface, double distance);

/// Whether fans of a surface see each other: whether a vertex of the one has not all triangles of
/// the other in its patch. Row and column for each fan.
std::vector<char> fans_that_see(const SurfaceTemplate &surface,
                                const std::vector<std::vector<int>> &patches,
                                const std::vector<TriangleFans::Place> &places);

}    // namespace rbc
