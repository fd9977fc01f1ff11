#pragma once

#include "fluid/flow.h"

namespace fluid {

struct Blob;
struct MarkerCloud;

/// Approximate inverse of the mobility of markers, from velocities to forces, for preconditioning:
/// a product of a sparse lower triangular matrix and its transpose. Markers are ordered from coarse
/// to fine, such that the first ones of any number cover the surface evenly. Each depends on those
/// before it within a few times the distance to the nearest of these, which is what is best for a
/// given sparsity (Schaefer, Katzfuss & Owhadi, SIAM J. Sci. Comput. 43 (2021) A2019). The mobility
/// is that of blobs of the size of the kernel in unbounded steady flow, corrected for sheets as
/// their velocities are, and the compliance of the markers.
///
/// Every rank knows all markers, so the result does not depend on the number of ranks.
class MobilityPreconditioner {
 public:
  /// Takes this rank's markers, in rows 0, 1, ... of their positions, and the body of each. Markers
  /// of different bodies, which may move relative to each other, are independent. Collective.
  void build(const Flow &flow, const MarkerSet &markers, const int *body);

  /// Computes the velocity with which markers yield to forces, in addition to that of the flow. It
  /// is that of a slip length of 0.0003 grid spacings, applied to the force of a marker less the
  /// mean traction within two spacings of it. Without it, forces that the kernel averages out
  /// (between markers much closer than a spacing) would be unbounded. From this most of what
  /// normal_alias() says is taken, applied to the normal part of this mean traction: what markers
  /// see though no fluid moves. Symmetric. Three numbers for each marker of this rank. Collective.
  void apply_compliance(const double *force, double *velocity);

  /// Collective.
  void apply(const double *velocity, double *force);

  std::size_t bytes() const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<int> numbers_, offsets_;    ///< of each rank: three numbers a marker
  int first_ = 0, count_ = 0;             ///< this rank's among all markers

  // Columns of this rank's markers: rows of markers, and 3 x 3 blocks. Memory sets the time to
  // apply them.
  std::vector<int> starts_, rows_;
  std::vector<float> blocks_;
  std::vector<double> all_, sums_;

  // Markers within the disc about each of this rank's, itself included, and the compliance to the
  // marker's own force and to that of the others.
  std::vector<int> disc_starts_, disc_;
  std::vector<double> own_compliance_;
  double other_compliance_ = 0;
  // Of all markers, along their normals: the product of two of them is what the one sees of the
  // other's force by normal_alias().
  std::vector<Real3> alias_;

  MarkerCloud gather(const Flow &flow, int count, const double *position, const int *body);
  std::vector<std::vector<int>> choose_rows(const MarkerCloud &cloud, double h) const;
  /// Returns the compliance of each marker of the cloud.
  std::vector<double> set_compliance(const MarkerCloud &cloud, const MarkerSet &markers, double h,
                                     double viscosity);
  void set_columns(const MarkerCloud &cloud, const std::vector<std::vector<int>> &columns,
                   const std::vector<double> &compliances, const Blob &blob);
  void add_column(const std::vector<Real3> &apart, const std::vector<double> &compliance,
                  const Blob &blob);
};

/// Radius of a sphere in unbounded flow with the mobility of one marker, over the spacing of the
/// grid.
double marker_radius(KernelKind kernel);

}    // namespace fluid
