#pragma once

#include "coupling.h"

#include <Eigen/Core>

namespace fluid {

/// Approximate inverse of the mobility of the markers of rigid surfaces: from velocities to forces. The markers of this
/// rank are divided into compact patches. Within a patch the mobility is that of the grid, between patches it is left out.
class PatchMobility {
 public:
  static inline int largest_patch = getenv("PATCH") ? atoi(getenv("PATCH")) : 160;    ///< markers

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

  void divide(const Grid &grid, int first, int last, const double *position);
};

}    // namespace fluid
