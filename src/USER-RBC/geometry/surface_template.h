#pragma once

#include "geometry/vec3.h"

#include <array>
#include <vector>

namespace rbc {

/// Inverse metric and area of a stress-free triangle, in the basis of its edges from corner 0.
struct ReferenceTriangle {
  double g11, g12, g22;
  double area;
};

/// Of an edge in the stress-free shape.
struct ReferenceHinge {
  double angle;
  double dual;    ///< distance of the circumcentres of its triangles, laid flat
};

/// Edge from a to b with the two triangles it joins: (a, b, c) to its left and (b, a, d) to its
/// right, seen from outside.
struct Hinge {
  int a, b, c, d;
  int left, right;
};

/// Closed oriented triangulated surface: topology and rest shape shared by all cells made from it.
/// Its own triangles are free of stress unless it takes those of another surface. Lengths in the
/// units of the coordinates.
class SurfaceTemplate {
 public:
  using Corners = std::array<int, 3>;

  /// Throws std::invalid_argument, saying why, unless the triangles form one closed surface that
  /// is oriented right-handed outward and uses every vertex.
  SurfaceTemplate(std::vector<Vec3> vertices, std::vector<Corners> triangles);

  int vertex_count() const { return static_cast<int>(vertices.size()); }

  /// Takes the stress-free triangles of another surface. Throws std::invalid_argument, saying
  /// which triangle differs, unless it joins the same vertices.
  void take_reference(const SurfaceTemplate &stress_free);

  std::vector<Vec3> vertices;
  std::vector<Corners> triangles;
  std::vector<Hinge> hinges;
  std::vector<ReferenceTriangle> reference;
  std::vector<ReferenceHinge> reference_hinges;
  std::array<std::vector<double>, 3> corner_share;    ///< of each triangle's area
  std::vector<double> vertex_area;            ///< each vertex's share of the area of the shape
  std::vector<double> curvature;              ///< mean curvature of the shape at each vertex
  std::vector<std::vector<int>> neighbors;    ///< vertices that share an edge
  std::vector<std::vector<int>> incident_triangles;    ///< triangles around each vertex
  double area = 0, volume = 0;
  double longest_edge = 0, mean_edge = 0;

 private:
  void connect_vertices();
  std::vector<Vec3> measure_triangles();
  void measure_hinges(const std::vector<Vec3> &normals);
};

}    // namespace rbc
