#pragma once

#include "geometry/vec3.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace rbc {

/// A translation and a rotation about a centre.
struct RigidMotion {
  Vec3 translation, rate;

  /// Velocity of a point, by its position from the centre.
  Vec3 at(const Vec3 &place) const { return translation + rate.cross(place); }
};

/// Fits rigid motions to the velocities of points, by least squares. Sums over the points come
/// first, so that several ranks can add theirs: all start at zero.
struct RigidFit {
  Vec3 centre;                 ///< mean of the points
  Eigen::Matrix3d mobility;    ///< turns the moment of the velocities into a rate of rotation

  static constexpr int of_places = 9, of_velocities = 6;    ///< numbers that are summed

  static void add_place(const Vec3 &place, double *sums)
  {
    for (int d = 0; d < 3; ++d) {
      sums[d] += place[d];
      sums[3 + d] += place[d] * place[d];
      sums[6 + d] += place[(d + 1) % 3] * place[(d + 2) % 3];
    }
  }

  RigidFit() = default;

  /// From the sums of `count` points, which do not lie on one line.
  RigidFit(const double *sums, int count) : centre(Vec3(sums) / count)
  {
    Eigen::Matrix3d products;
    products << sums[3], sums[8], sums[7], sums[8], sums[4], sums[6], sums[7], sums[6], sums[5];
    products -= count * centre * centre.transpose();
    mobility = (products.trace() * Eigen::Matrix3d::Identity() - products).inverse();
  }

  /// `place` is the position from the centre.
  static void add_velocity(const Vec3 &place, const Vec3 &velocity, double *sums)
  {
    const Vec3 moment = place.cross(velocity);
    for (int d = 0; d < 3; ++d) {
      sums[d] += velocity[d];
      sums[3 + d] += moment[d];
    }
  }

  RigidMotion motion(const double *sums, int count) const
  {
    return {Vec3(sums) / count, mobility * Vec3(sums + 3)};
  }
};

}    // namespace rbc
