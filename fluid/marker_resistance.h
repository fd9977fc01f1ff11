#pragma once

#include "flow.h"

namespace fluid {

/// Approximate inverse of the mobility of markers, from velocities to forces, for preconditioning: a product of a sparse
/// lower triangular matrix and its transpose. Markers are ordered from coarse to fine, such that the first ones of any
/// number cover the surface evenly. Each depends on those before it within a few times the distance to the nearest of
/// these, which is what is best for a given sparsity (Schaefer, Katzfuss & Owhadi, SIAM J. Sci. Comput. 43 (2021) A2019).
/// The mobility is that of blobs of the size of the kernel in unbounded steady flow, and the compliance of the markers.
///
/// All tasks know all markers: the result does not depend on their number.
class MarkerResistance {
 public:
  /// Of this task's markers, three numbers each; those of different bodies, which may move relative to each other, are
  /// independent. Collective.
  void build(const Flow &flow, KernelKind kernel, int count, const double *position,
             const int *body);

  /// Velocity that a marker yields to a unit force, beyond that of the flow: that of a surface with a slip length of a
  /// thousandth of the grid's spacing. Forces that the kernel blurs away, as between markers much closer than a
  /// spacing, would be without bounds otherwise.
  double compliance(int marker) const { return compliance_[marker]; }

  /// Collective.
  void apply(const double *velocity, double *force);

  std::size_t bytes() const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<int> numbers_, offsets_;    ///< of all tasks: three a marker
  int first_ = 0, count_ = 0;             ///< of this task's among all markers

  // Columns of this task's markers: rows of markers, and 3 x 3 blocks.
  std::vector<int> starts_, rows_;
  std::vector<double> blocks_;
  std::vector<double> all_, compliance_;

  void add_column(const std::vector<Vec3> &apart, const std::vector<double> &compliance,
                  double viscosity, double radius);
};

/// Radius of a sphere in unbounded flow with the mobility of one marker, over the spacing of the grid.
double marker_radius(KernelKind kernel);

}    // namespace fluid
