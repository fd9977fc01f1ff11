#pragma once

#include "coupling.h"

#include <Eigen/Core>

namespace fluid {

/// Approximate inverse of the mobility of the markers of rigid surfaces: from velocities to forces. The markers of this
/// rank are divided into compact patches. Within a patch the mobility is that of blobs in unbounded steady Stokes flow,
/// whose size is that of the kernel; between patches it is left out.
class PatchMobility {
 public:
  static constexpr int largest_patch = 160;    ///< markers

  /// Three numbers a marker; those of different bodies, which may move relative to each other, share no patch.
  void build(KernelKind kernel, const Grid &grid, double viscosity, int count,
             const double *position, const int *body);

  /// force = inverse mobility . velocity: symmetric and positive definite.
  void apply(const double *velocity, double *force);

  std::size_t bytes() const;

 private:
  struct Patch {
    int first, count;    ///< in order_
    Eigen::MatrixXd inverse;
  };
  std::vector<int> order_;    ///< of the markers, patch by patch
  std::vector<Patch> patches_;
  Eigen::VectorXd gathered_, solved_;

  void divide(int first, int last, const double *position);
};

/// Radius of a sphere in unbounded flow with the mobility of one marker, over the spacing of the grid.
double marker_radius(KernelKind kernel);

}    // namespace fluid
