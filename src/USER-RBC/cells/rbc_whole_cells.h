#ifndef LMP_RBC_WHOLE_CELLS_H
#define LMP_RBC_WHOLE_CELLS_H

#include "geometry/vec3.h"

#include <vector>

namespace LAMMPS_NS {

class LocalCells;
class LAMMPS;

/// The mean of the vertices of each cell, in the order of the cells, unwrapped. Only rank 0 gets
/// it, the others nothing. Collective.
std::vector<rbc::Vec3> centres_on_first(LAMMPS *lmp, const LocalCells &cells, int vertices);

/// The vertices of the cells that rank 0 wants, a number for each cell, in their order, unwrapped.
/// Only rank 0 gets them. Collective.
std::vector<std::vector<rbc::Vec3>> vertices_on_first(LAMMPS *lmp, const LocalCells &cells,
                                                      int vertices, std::vector<char> wanted);

}    // namespace LAMMPS_NS

#endif
