#ifndef LMP_RBC_GROUP_CELLS_H
#define LMP_RBC_GROUP_CELLS_H

#include "cells/rbc_cell_membranes.h"
#include "lmptype.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

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

  /// -1 for a molecule that is not a cell of the group.
  int index_of(tagint molecule) const;

 private:
  std::string owner;
  std::vector<CellMembranes *> members;
  std::vector<tagint> ids;

  void collect(int groupbit);
};

}    // namespace LAMMPS_NS

#endif
