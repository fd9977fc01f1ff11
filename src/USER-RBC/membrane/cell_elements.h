#pragma once

#include "geometry/surface_template.h"

namespace rbc {

/// The elements of one cell that a rank evaluates: all of them, or for a cell that other ranks
/// share those needed for the forces on the vertices it owns. All indices below are positions in
/// these local lists.
struct CellElements {
  std::vector<char> owned;               ///< of each vertex of the template
  std::vector<int> triangles, hinges;    ///< of the template
  int owned_triangles = 0;               ///< triangles that touch an owned vertex; they come first

  std::array<std::vector<int>, 3> corners;     ///< of each triangle
  std::array<std::vector<int>, 3> opposite;    ///< of the owned triangles: hinge facing each corner
  std::vector<int> begin, end;                 ///< vertices of each hinge: a and b
  std::vector<int> left, right;                ///< triangles of each hinge

  /// 1 where this rank counts the energy, 0 where another does: the owner of the first vertex.
  std::vector<double> triangle_energy_weight, hinge_energy_weight;

  /// Corners around each owned vertex, and their triangles: of vertex v from incident_begin[v] to
  /// incident_begin[v + 1]. Corner c of triangle t is c * owned_triangles + t.
  std::vector<int> incident_corners, incident_triangles, incident_begin;

  static CellElements whole(const SurfaceTemplate &shape);

  /// Elements around the owned vertices, and with bending around their neighbors too.
  static CellElements part(const SurfaceTemplate &shape, std::vector<char> owned, bool bending);

 private:
  void connect(const SurfaceTemplate &shape);
};

}    // namespace rbc
