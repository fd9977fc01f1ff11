#pragma once

#include "fluid/flow.h"

namespace fluid {

/// Approximate inverse of the mobility of markers, from velocities to forces, for preconditioning:
/// a product of a sparse lower triangular matrix and its transpose. Markers are ordered from coarse
/// to fine, such that the first ones of any number cover the surface evenly. Each depends on those
/// before it within a few times the distance to the nearest of these, which is what is best for a
/// given sparsity (Schaefer, Katzfuss & Owhadi, SIAM J. Sci. Comput. 43 (2021) A2019). The mobility
/// is that of blobs of the size of the kernel in unbounded steady flow, and the compliance of the
/// markers.
///
/// All tasks know all markers: the result does not depend on their number.
class MobilityPreconditioner {
 public:
  /// Of this task's markers, three numbers each; those of different bodies, which may move relative
  /// to each other, are independent. Collective.
  void build(const Flow &flow, KernelKind kernel, int count, const double *position,
             const int *body);

  /// Velocity with which markers yield to forces, beyond that of the flow: as a slip length of
  /// 0.0003 of the grid's spacing would give for the part of the traction that differs from the
  /// mean within two spacings. Forces that the kernel blurs away, as between markers much closer
  /// than a spacing, would be without bounds otherwise. Symmetric and positive semidefinite.
  /// Collective.
  void apply_compliance(const double *force, double *velocity);

  /// Collective.
  void apply(const double *velocity, double *force);

  std::size_t bytes() const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<int> numbers_, offsets_;    ///< of all tasks: three a marker
  int first_ = 0, count_ = 0;             ///< of this task's among all markers

  // Columns of this task's markers: rows of markers, and 3 x 3 blocks. Memory sets the time to
  // apply them.
  std::vector<int> starts_, rows_;
  std::vector<float> blocks_;
  std::vector<double> all_, sums_;

  // Markers within the disc about each of this task's, itself included; for its own force, and for
  // that of the others.
  std::vector<int> disc_starts_, disc_;
  std::vector<double> own_compliance_;
  double other_compliance_ = 0;

  void add_column(const std::vector<Real3> &apart, const std::vector<double> &compliance,
                  double viscosity, double radius);
};

/// Radius of a sphere in unbounded flow with the mobility of one marker, over the spacing of the
/// grid.
double marker_radius(KernelKind kernel);

}    // namespace fluid
