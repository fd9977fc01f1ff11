#pragma once

#include "geometry/packing_box.h"
#include "geometry/signed_distance.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace rbc {

/// What a triangulated surface encloses. The surface is closed, or leaves the box through periodic
/// faces and comes back through those opposite: then it goes on through all images of the box in
/// these directions.
class TriangulatedSolid {
 public:
  /// Throws std::invalid_argument, saying why, unless the surface is closed and consistently
  /// oriented.
  TriangulatedSolid(std::vector<Triangle> triangles, const PackingBox &box);

  /// Points on the surface are inside.
  bool contains(const Vec3 &x) const;

  struct Nearest {
    Vec3 from_surface;    ///< vector from the closest point of the surface
    double distance;      ///< negative inside
  };

  /// Nothing if the surface is not nearer than `cutoff`.
  std::optional<Nearest> nearest(const Vec3 &x, double cutoff) const;

  /// Directions in which the surface leaves the box.
  const std::array<bool, 3> &periodic() const { return box_.periodic; }

  /// Within the box.
  double volume() const { return volume_; }
  const Vec3 &lo() const { return lo_; }
  const Vec3 &hi() const { return hi_; }

 private:
  struct Best {
    double square;
    int triangle = -1;
    std::array<double, 3> weights{};
    Vec3 from_surface = Vec3::Zero();
  };

  PackingBox box_;
  std::vector<Triangle> triangles_;
  Vec3 lo_, hi_;
  double volume_ = 0;

  std::vector<FeatureNormals> normals_;    ///< of each triangle
  Eigen::KdBVH<double, 3, int> tree_;

  // signed distances from the centres of coarse cells: far from the surface they tell the side
  Vec3 cell_;
  std::array<int, 3> cells_{};
  double rounding_ = 0;
  std::vector<float> centre_distance_;

  // who asks for the side of a point often asks for its distance next
  mutable Vec3 last_ = Vec3::Constant(NAN);
  mutable Nearest nearest_to_last_;

  void orient();
  void index();
  void measure_centres();
  Vec3 wrapped(const Vec3 &x) const;
  Vec3 centre(std::size_t cell) const;

  /// What the cell around a place tells of its distance from the surface: it differs from that of
  /// the centre by at most the way from there.
  struct Estimate {
    double distance, error;
    double largest() const { return 1.001 * (std::abs(distance) + error); }
  };
  Estimate estimate(const Vec3 &x) const;
  bool beyond(const Vec3 &x) const;
  Nearest exact(const Vec3 &x, Best best) const;
  void search(const Vec3 &x, Best &best) const;
  void descend(int node, const Vec3 &x, Best &best) const;
  void try_triangle(int t, const Vec3 &x, Best &best) const;
};

}    // namespace rbc
