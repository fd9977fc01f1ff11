#pragma once

#include "geometry/triangle_distance.h"

#include <vector>

namespace rbc {

class MeshConnectivity;

/// Of a surface that is closed, right-handed outward as a whole, and consists of parts that are not
/// joined. Throws std::invalid_argument, saying where, if a part is turned the other way and is no
/// cavity of another, or lies within another that is turned alike.
void check_shells(const std::vector<Triangle> &triangles, const MeshConnectivity &mesh);

}    // namespace rbc
