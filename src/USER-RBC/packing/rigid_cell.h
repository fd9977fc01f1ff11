#pragma once

#include "geometry/distance_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rbc {

/// Cells of one template as rigid bodies.
struct RigidShape {
  /// Other cells are seen up to `reach`.
  RigidShape(const SurfaceTemplate &surface_in, double reach) :
      surface(surface_in), field(surface_in, reach)
  {
    double square = 0;
    for (const Vec3 &vertex : surface.vertices) {
      radius = std::max(radius, vertex.norm());
      square += vertex.squaredNorm() / surface.vertex_count();
    }
    gyration = std::sqrt(square);
  }

  const SurfaceTemplate &surface;
  DistanceField field;
  double radius = 0;      ///< of the sphere about the origin that holds the shape
  double gyration = 0;    ///< of the vertices about the origin
};

/// A cell in place: `size` times its template, turned and shifted.
struct RigidCell {
  const RigidShape *shape;
  Vec3 centre;
  Eigen::Matrix3d rotation;
  double size;

  Vec3 vertex(int v) const { return centre + size * (rotation * shape->surface.vertices[v]); }

  /// Into the coordinates of the template.
  Vec3 body(const Vec3 &x) const { return rotation.transpose() * (x - centre) / size; }
};

/// Force and torque about the centre of a cell, and by how much it overlaps most. Lengths in those
/// of the template.
struct Wrench {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double overlap = 0;

  void add(const Vec3 &arm, const Vec3 &f, double depth)
  {
    force += f;
    torque += arm.cross(f);
    overlap = std::max(overlap, depth);
  }
};

}    // namespace rbc
