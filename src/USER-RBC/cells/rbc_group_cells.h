#ifndef LMP_RBC_GROUP_CELLS_H
#define LMP_RBC_GROUP_CELLS_H

#include "cells/rbc_cell_membranes.h"
#include "lmptype.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Collective: between runs an error, which `style` begins, if what `known` membranes know of their
/// cells is out of date: atoms, the box or fixes rbc/membrane have changed since the last run.
void check_atoms_are_those_of_last_run(LAMMPS *lmp, const std::string &style,
                                       const std::vector<CellMembranes *> &known);

/// The cells of all fixes rbc/membrane whose atoms are all in a group, numbered in order of
/// molecule ID.
class GroupCells : protected Pointers {
 public:
  /// `owner` names the style and its ID in errors.
  GroupCells(LAMMPS *lmp, std::string owner) : Pointers(lmp), owner(std::move(owner)) {}

  /// Collective: finds the cells at the start of a run.
  void find(int groupbit);

  /// The same within a run, once the membranes know of cells that were added or removed.
  void find_again(int groupbit) { collect(groupbit); }

  const std::vector<CellMembranes *> &membranes() const { return members; }
  const std::vector<tagint> &molecules() const { return ids; }
  int size() const { return static_cast<int>(ids.size()); }

  /// Collective, where the cells are about to be used: between runs an error if they are not those
  /// of the last run.
  void check() const { check_atoms_are_those_of_last_run(lmp, owner, members); }

  /// -1 for a molecule that is not a cell of the group.
  int index_of(tagint molecule) const;

  /// Of which an atom is a vertex, or -1. Others may have the same molecule ID.
  int cell_of(int i) const;

 private:
  std::string owner;
  std::vector<CellMembranes *> members;
  std::vector<tagint> ids;

  void collect(int groupbit);
};

}    // namespace LAMMPS_NS

#endif
