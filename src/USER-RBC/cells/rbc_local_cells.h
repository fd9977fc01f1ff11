#ifndef LMP_RBC_LOCAL_CELLS_H
#define LMP_RBC_LOCAL_CELLS_H

#include "cells/rbc_cell_directory.h"
#include "cells/rbc_cell_images.h"
#include "cells/rbc_shared_sums.h"
#include "lmptype.h"
#include "membrane/membrane_model.h"
#include "pointers.h"
#include "support/rbc_collective_stop.h"

#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

/// The cells made from one template in a group, and what this rank holds of them. A vertex is known
/// by its atom ID: those of a cell are consecutive, in the order of the template. Cells are
/// numbered in order of molecule ID. A rank knows the number of all cells, and more only of those
/// that it has atoms of.
class LocalCells : protected Pointers {
 public:
  /// One cell of which this rank owns a vertex.
  struct Cell {
    int index;                 ///< among all cells
    tagint molecule, first;    ///< its ID and the lowest atom ID
    const rbc::CellElements *elements;
    const int *atom;    ///< local index of each vertex, -1 where unknown
    CellOffsets::OfCell
        offset;    ///< of each vertex, from LAMMPS's position to one near the origin
    /// From where the cell's coordinates count. The boxes that lie between are those of the first
    /// vertex's image flags.
    rbc::Vec3 origin;
    bool shared;    ///< whether other ranks have parts of it, too

    /// Of an owned vertex, unwrapped; x are the positions of LAMMPS's atoms.
    rbc::Vec3 position(int v, const double *const *x) const
    {
      return rbc::Vec3(x[atom[v]]) + offset[v] + origin;
    }
  };

  LocalCells(LAMMPS *lmp, const rbc::SurfaceTemplate &shape, int groupbit, std::string style);

  /// Collective, at the start of a run: finds the group's cells and checks that each is whole.
  void identify();

  /// The same within a run, after cells were added or removed: image flags are right.
  void identify_again();

  /// Collective, after atoms migrated: finds which vertices this rank holds. With `bending` the
  /// forces on a vertex reach its neighbors' neighbors.
  void update_ownership(bool bending);

  /// Collective, where atoms may have changed since update_ownership(): learns of the cells that
  /// atoms here belong to, ghosts too.
  void meet_cells();

  /// Of all ranks.
  bigint count() const { return directory.count(); }
  const CellDirectory &all() const { return directory; }

  /// The cells that atoms here belong to, ghosts too, by molecule ID.
  struct KnownCell {
    tagint first;    ///< lowest atom ID
    int index;       ///< among all cells
    int place;       ///< in cells(), -1 where all atoms here are ghosts
  };
  using Known = std::unordered_map<tagint, KnownCell>;
  const Known &known() const { return known_cells; }

  const std::vector<Cell> &cells() const { return local; }

  /// Writes to x, an entry for each vertex of the template, the positions relative to cell.origin.
  /// Entries of vertices that this rank does not know are left alone.
  void gather(const Cell &cell, std::vector<rbc::Vec3> &x) const;

  /// Sums `values`, `width` numbers for each of cells(), over ranks for the cells that several
  /// ranks share, to be called by all of these. The values of other cells stay as they are.
  void sum_shared(std::vector<double> &values, int width);

  /// Whether ranks share cells; the same on all of them.
  bool has_shared() const { return sums.any(); }

  /// The edge of all cells that is stretched most. Collective, after update_ownership().
  CellImages::Stretch largest_stretch() { return images.largest_stretch(*this); }

  double bytes() const;

 private:
  const rbc::SurfaceTemplate &shape;
  int groupbit;
  std::string style;

  CellDirectory directory;
  Known known_cells;
  bigint vertices_of_all = 0;    ///< owned by all ranks, at the last meet_cells()

  std::vector<Cell> local;
  std::vector<int> atoms;
  CellOffsets offsets;
  CellImages images;
  bool starts_run = true;    ///< the next update_ownership() is the first one of a run
  rbc::CellElements whole;
  std::vector<rbc::CellElements> parts;
  SharedSums sums;

  void ask_for(std::vector<tagint> molecules);
  std::vector<int> find_owned();
  void find_parts(const std::vector<int> &owned_count, bool bending);
  void check_complete(const std::vector<int> &owned_count) const;
  void find_neighbors(std::size_t at, tagint first, const std::vector<char> &owned, int rings);
  void check_neighbors(std::size_t c, int rings, CollectiveStop &stop) const;
  void find_partners();
  void find_images(bool starts_run);
  void set_origins();
};

}    // namespace LAMMPS_NS

#endif
