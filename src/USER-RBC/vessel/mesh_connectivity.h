#pragma once

#include "geometry/packing_box.h"
#include "geometry/triangle_distance.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace rbc {

/// Of the length of a box: corners nearer to a face lie on it.
constexpr double face_share = 1e-5;

/// Which triangles of a surface meet, also behind periodic faces of a box through which the
/// surface goes on.
class MeshConnectivity {
 public:
  /// Joins corners at the same place, takes out triangles that have no area then, and puts the
  /// ends of the surface on the faces exactly. Throws std::invalid_argument, saying where, unless
  /// the surface is closed and all triangles are oriented alike.
  MeshConnectivity(std::vector<Triangle> &triangles, const PackingBox &box);

  int vertices() const { return static_cast<int>(places_.size()); }

  /// Number of the vertex at a corner; the same at both ends.
  int vertex(int triangle, int corner) const { return twins_[corners_[triangle][corner]]; }

  /// Across the edge that begins at a corner.
  int neighbor(int triangle, int edge) const { return neighbors_[triangle][edge]; }

  /// Directions in which the surface leaves the box.
  const std::array<bool, 3> &open() const { return open_; }

 private:
  using Corners = std::array<int, 3>;
  using Edge = std::pair<int, int>;     ///< its vertices
  using Place = std::pair<int, int>;    ///< a triangle and which edge of it

  std::vector<Corners> corners_, neighbors_;
  std::vector<Vec3> places_;
  std::vector<int> twins_;    ///< of vertices on a face: the first at that place, or an image of it
  std::array<bool, 3> open_{};

  void weld(std::vector<Triangle> &triangles);
  std::map<Edge, Place> join();
  void close(const std::map<Edge, Place> &ends, PackingBox box);
  std::string name(const Edge &edge) const;
};

}    // namespace rbc
