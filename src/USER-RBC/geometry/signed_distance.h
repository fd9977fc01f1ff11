#pragma once

#include "geometry/triangle_distance.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rbc {

/// The face, edge or corner of a triangle on which a point of it lies.
struct TriangleFeature {
  int count = 0;    ///< corners of the feature: 3 for the face, 2 for an edge, 1 for a corner
  std::array<int, 3> corner;    ///< which of the triangle's corners these are

  /// From the weights of the corners at the point, which are exactly zero off the feature, as
  /// closest_point_weights() makes them.
  explicit TriangleFeature(const std::array<double, 3> &weight)
  {
    for (int c = 0; c < 3; ++c)
      if (weight[c] != 0) corner[count++] = c;
  }
};

/// Outward directions, not of unit length, at the face, edges and corners of a triangle of a
/// closed surface. A point is outside if its line from the closest point of the surface goes along
/// the direction there. At an edge this is the sum of both normals; at a corner the normals are
/// weighted with the angles of their triangles (Baerentzen and Aanaes, IEEE Trans Vis Comput Graph
/// 11 (2005) 243).
struct FeatureNormals {
  Vec3 face;
  std::array<Vec3, 3> edge;    ///< opposite to each corner
  std::array<Vec3, 3> corner;

  const Vec3 &at(const std::array<double, 3> &weight) const
  {
    const TriangleFeature feature(weight);
    if (feature.count == 3) return face;
    if (feature.count == 2) return edge[3 - feature.corner[0] - feature.corner[1]];
    return corner[feature.corner[0]];
  }

  /// Those of the same triangle with its last two corners swapped.
  void turn_over()
  {
    face = -face;
    std::swap(edge[1], edge[2]);
    std::swap(corner[1], corner[2]);
    for (Vec3 &normal : edge) normal = -normal;
    for (Vec3 &normal : corner) normal = -normal;
  }
};

/// Normals of all triangles of a closed surface with `vertices` vertices. vertex(t, c) is the
/// number of the vertex at a corner, neighbor(t, c) the triangle across the edge from that corner
/// to the next.
template <typename Vertex, typename Neighbor>
std::vector<FeatureNormals> feature_normals(const std::vector<Triangle> &triangles, int vertices,
                                            const Vertex &vertex, const Neighbor &neighbor)
{
  const int count = static_cast<int>(triangles.size());
  std::vector<FeatureNormals> normals(count);
  for (int t = 0; t < count; ++t) {
    const Triangle &p = triangles[t];
    normals[t].face = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
  }
  std::vector<Vec3> at_vertex(vertices, Vec3::Zero());
  for (int t = 0; t < count; ++t)
    for (int c = 0; c < 3; ++c) {
      const Triangle &p = triangles[t];
      const Vec3 u = p[(c + 1) % 3] - p[c], v = p[(c + 2) % 3] - p[c];
      at_vertex[vertex(t, c)] += std::atan2(u.cross(v).norm(), u.dot(v)) * normals[t].face;
      normals[t].edge[(c + 2) % 3] = normals[t].face + normals[neighbor(t, c)].face;
    }
  for (int t = 0; t < count; ++t)
    for (int c = 0; c < 3; ++c) normals[t].corner[c] = at_vertex[vertex(t, c)];
  return normals;
}

}    // namespace rbc
