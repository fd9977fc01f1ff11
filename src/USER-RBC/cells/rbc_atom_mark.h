#ifndef LMP_RBC_ATOM_MARK_H
#define LMP_RBC_ATOM_MARK_H

#include "pointers.h"

#include <cstdint>

namespace LAMMPS_NS {

/// Tells whether the atoms of this rank, or the box, have changed since they were marked. What was
/// found of cells before is then of no use: it has the numbers and the ghosts of atoms.
class AtomMark : protected Pointers {
 public:
  explicit AtomMark(LAMMPS *lmp) : Pointers(lmp) {}

  void set();

  /// Whether atoms have other numbers, IDs, molecules, positions or image flags, or the box another
  /// size, or set() was never called. Not collective.
  bool is_old() const;

 private:
  bool is_set_ = false;
  std::uint64_t mark_ = 0;

  std::uint64_t now() const;
};

}    // namespace LAMMPS_NS

#endif
