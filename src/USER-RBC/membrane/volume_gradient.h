#pragma once

#include "geometry/vector_array.h"
#include "membrane/cell_elements.h"

namespace rbc {

/// How the volume of a closed surface changes with its vertices, dV/dx: a third of the area vectors
/// of the triangles around each.
class VolumeGradient {
 public:
  /// For cells of one shape.
  explicit VolumeGradient(const SurfaceTemplate &shape) : area_vector_(shape.triangles.size()) {}

  /// At the vertices owned (others get zero), with an entry of x and of the gradient for each
  /// vertex of the template. Returns this rank's share of the volume, which is of third degree in
  /// positions: V = sum of x . dV/dx / 3.
  double find(const CellElements &elements, const Vec3 *x, Vec3 *gradient);

 private:
  VectorArray area_vector_;    ///< of each triangle, twice
};

}    // namespace rbc
