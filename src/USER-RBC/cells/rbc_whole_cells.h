#ifndef LMP_RBC_WHOLE_CELLS_H
#define LMP_RBC_WHOLE_CELLS_H

#include "geometry/vec3.h"
#include "lmptype.h"

#include <vector>

namespace LAMMPS_NS {

class LocalCells;
class LAMMPS;

/// The mean of the vertices of each of cells.cells(), unwrapped, the same on all ranks that have
/// parts of it. Collective.
std::vector<rbc::Vec3> cell_centres(const LAMMPS *lmp, LocalCells &cells, int vertices);

/// Whether this rank is the one, of those that have parts of a cell, that speaks for it.
bool speaks_for(const LocalCells &cells, std::size_t c);

/// A cell as a whole, unwrapped.
struct WholeCell {
  tagint molecule;
  rbc::Vec3 centre;
  std::vector<rbc::Vec3> vertices;
};

/// The cells that are wanted, a number for each of cells.cells(), in order of molecule ID. All
/// ranks that have parts of a cell want it or do not. Only rank 0 gets them. Collective.
std::vector<WholeCell> whole_cells_on_first(const LAMMPS *lmp, const LocalCells &cells,
                                            int vertices, const std::vector<rbc::Vec3> &centres,
                                            const std::vector<char> &wanted);

}    // namespace LAMMPS_NS

#endif
