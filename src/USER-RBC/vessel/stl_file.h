#pragma once

#include "geometry/triangle_distance.h"

#include <string>
#include <vector>

namespace rbc {

/// Triangles of an STL file, text or binary. Throws std::invalid_argument, saying what is wrong
/// with it.
std::vector<Triangle> read_stl(const std::string &path);

}    // namespace rbc
