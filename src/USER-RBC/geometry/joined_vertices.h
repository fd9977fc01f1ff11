#pragma once

#include "geometry/surface_template.h"

#include <vector>

namespace rbc {

/// Puts the vertices of a surface together that a periodic box holds apart: a vertex is at the
/// image that is nearest to a vertex with which it shares an edge. Which box a vertex is in does
/// not count. The image is the right one if no edge is longer than half of the box.
class JoinedVertices {
 public:
  /// Where one cell's vertices are. Entries are those of the template; they belong to the caller.
  struct Cell {
    const Vec3 *x;        ///< in any image
    const char *known;    ///< whether there is a position
    char *placed;         ///< whether there is a shift
    Vec3 *shift;          ///< from x to where the vertex is, in whole periods
  };

  explicit JoinedVertices(const SurfaceTemplate &shape) : shape_(&shape) {}

  /// Lengths of the box. It is 0 in a direction that is not periodic.
  void set_periods(const Vec3 &periods) { periods_ = periods; }

  /// Places all known vertices that edges join to those that are placed.
  void join(const Cell &cell);

  struct Edge {
    int a = -1, b = -1;
    double ratio = 0;    ///< to what is compared
  };

  /// The edge of known vertices that is longest compared with half of the period of the box, in
  /// the direction in which it is; the ratio is above 1 if the vertices cannot be put together.
  Edge widest(const Cell &cell) const;

  /// The edge of known vertices that is longest compared with its length in the template.
  Edge most_stretched(const Cell &cell) const;

 private:
  const SurfaceTemplate *shape_;
  Vec3 periods_ = Vec3::Zero();
  std::vector<int> open_;

  Vec3 nearest_shift(const Vec3 &from, const Vec3 &to) const;
};

}    // namespace rbc
