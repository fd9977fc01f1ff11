#ifndef LMP_RBC_RIGID_MOTIONS_H
#define LMP_RBC_RIGID_MOTIONS_H

#include "geometry/rigid_motion.h"

#include <vector>

namespace LAMMPS_NS {

class CellMembranes;

/// The rigid motions of the cells of one fix rbc/membrane: for each the translation and rotation
/// from which the velocities of its vertices differ least, in the sum of squares.
class RigidMotions {
 public:
  explicit RigidMotions(CellMembranes &membranes) : membranes_(membranes) {}

  /// Learns where the vertices are: to be called after atoms moved or migrated. `x` are the
  /// positions of LAMMPS's atoms. Collective.
  void find_places(const double *const *x);

  /// Fits rigid motions to `velocity` and sets the rows of `rigid` that belong to vertices: three
  /// numbers for each of this rank's atoms. Other rows stay as they are. Collective.
  void find(const double *velocity, double *rigid);

  std::size_t bytes() const;

 private:
  CellMembranes &membranes_;
  std::vector<rbc::RigidFit> fits_;    ///< of the cells here
  std::vector<rbc::Vec3> places_;      ///< of this rank's vertices, cell by cell, from the centre
  std::vector<double> sums_;

  template <typename Visit> void visit_vertices(Visit visit) const;
};

}    // namespace LAMMPS_NS

#endif
