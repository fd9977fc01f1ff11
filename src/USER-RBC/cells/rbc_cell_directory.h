#ifndef LMP_RBC_CELL_DIRECTORY_H
#define LMP_RBC_CELL_DIRECTORY_H

#include "lmptype.h"
#include "pointers.h"
#include "support/rbc_molecule_shares.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// The cells made from one template in a group. Cells are numbered in order of molecule ID. No rank
/// has a list of them all: each keeps the entries of some molecule IDs, and others ask it.
class CellDirectory : protected Pointers {
 public:
  struct Entry {
    tagint molecule;
    tagint first;    ///< lowest atom ID
    int index;       ///< among all cells
  };

  /// How many of a cell's vertices a rank has.
  struct Part {
    tagint molecule;
    int vertices;

    void include(const Part &other) { vertices += other.vertices; }
  };

  /// `style` names the fix in errors.
  CellDirectory(LAMMPS *lmp, int vertices, int groupbit, std::string style);

  /// Collective: finds the cells and checks that each is whole.
  void identify();

  /// Of all ranks.
  bigint count() const { return count_; }

  /// Collective: the entries of these molecules that are cells, in no order.
  std::vector<Entry> find(const std::vector<tagint> &molecules) const;

  /// The molecule IDs of the entries that this rank keeps, ascending and above those of the ranks
  /// before it.
  const std::vector<tagint> &kept() const { return molecules_; }

  /// Collective: of the first cell that misses vertices, the molecule ID and how many there are.
  /// Each rank tells what it has. At least one cell must miss some.
  Part first_incomplete(std::vector<Part> mine) const;

  double bytes() const;

 private:
  /// Atoms of a molecule: lowest and highest ID, and how many.
  struct Extent {
    tagint molecule, first, last;
    bigint count;

    void include(const Extent &other);
  };

  int vertices_, groupbit_;
  std::string style_;
  MoleculeShares shares_;
  bigint count_ = 0;
  int first_index_ = 0;    ///< of the cells kept here
  std::vector<tagint> molecules_, first_atoms_;

  std::vector<Extent> extents_here() const;
  std::string flaw_of(const Extent &cell) const;
};

}    // namespace LAMMPS_NS

#endif
