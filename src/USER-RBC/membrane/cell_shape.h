#pragma once

#include "geometry/surface_template.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rbc {

/// Integrals over the volume a closed surface encloses, summed over its triangles in any order.
struct VolumeMoments {
  double area = 0, volume = 0;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  /// Adds the tetrahedron between the origin and a triangle, right-handed outward.
  void add(const Vec3 &a, const Vec3 &b, const Vec3 &c)
  {
    const Vec3 sum = a + b + c;
    const double tetrahedron = a.dot(b.cross(c)) / 6;
    area += (b - a).cross(c - a).norm() / 2;
    volume += tetrahedron;
    first += tetrahedron / 4 * sum;
    second += tetrahedron / 20 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }

  Vec3 centre() const { return first / volume; }
};

/// Ellipsoid with the same volume moments, semi-axes in falling order.
struct InertiaEllipsoid {
  Vec3 semi_axes;
  Vec3 long_axis, short_axis;

  explicit InertiaEllipsoid(const VolumeMoments &moments)
  {
    const Vec3 centre = moments.centre();
    const Eigen::Matrix3d covariance =
        moments.second / moments.volume - centre * centre.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
    for (int n = 0; n < 3; ++n)
      semi_axes[n] = std::sqrt(5 * std::max(0.0, eigen.eigenvalues()[2 - n]));
    long_axis = directed(eigen.eigenvectors().col(2));
    short_axis = directed(eigen.eigenvectors().col(0));
  }

  /// Taylor deformation (L - B) / (L + B) of the longest and the shortest axis.
  double deformation() const
  {
    return (semi_axes[0] - semi_axes[2]) / (semi_axes[0] + semi_axes[2]);
  }

 private:
  /// An axis has no sign: its first component that is not zero is made positive.
  static Vec3 directed(const Vec3 &axis)
  {
    for (int d = 0; d < 3; ++d)
      if (std::abs(axis[d]) > 1e-12) return axis[d] > 0 ? axis : Vec3(-axis);
    return axis;
  }
};

}    // namespace rbc
