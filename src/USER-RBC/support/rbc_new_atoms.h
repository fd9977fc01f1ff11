#ifndef LMP_RBC_NEW_ATOMS_H
#define LMP_RBC_NEW_ATOMS_H

#include "pointers.h"

#include <Eigen/Core>
#include <string>

namespace LAMMPS_NS {

/// Atoms made at places that all tasks know, in the same order on all; each task makes those that
/// it owns. Their IDs follow those of the atoms that are there, and are above a given one.
class NewAtoms : protected Pointers {
 public:
  /// Collective. `style` is named in the error if there are no IDs for `count` atoms.
  NewAtoms(LAMMPS *lmp, const std::string &style, bigint count, tagint above = 0);

  struct Made {
    int index;    ///< -1: another task's
    imageint image;
  };

  /// The next one. Its image is left at that of the box.
  Made add(int type, Eigen::Vector3d x);

  /// Collective, after the last.
  void finish();

  /// As LAMMPS wants a mass of each type.
  void set_missing_mass(int type);

 private:
  tagint last_;
  int before_;
};

}    // namespace LAMMPS_NS

#endif
