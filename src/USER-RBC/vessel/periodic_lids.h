#pragma once

#include "geometry/packing_box.h"
#include "geometry/triangle_distance.h"

#include <array>
#include <vector>

namespace rbc {

/// Triangles of a surface that lie flat on the lower and on the upper face of a box across one
/// direction.
struct Lids {
  std::array<int, 2> triangles{};

  /// The extents of those below and above overlap, so that a vessel would be closed there that
  /// goes on through the faces.
  bool facing = false;
};

/// Lids on the periodic faces of a box, by direction; none in directions that are not periodic.
/// Triangles without area do not count. Each rank may call this by itself.
std::array<Lids, 3> find_lids(const std::vector<Triangle> &triangles, const PackingBox &box);

}    // namespace rbc
