#ifndef LMP_RBC_WALL_SPACING_H
#define LMP_RBC_WALL_SPACING_H

#include "coupling/rbc_wall_group.h"

#include <array>

namespace LAMMPS_NS {

/// Collective, at the setup of a run: warns if more than a tenth of the atoms of a wall are so far
/// from others that fluid passes between them. `cells`: of the fluid's grid, along each direction.
void warn_of_coarse_wall(LAMMPS *lmp, const WallGroup &wall, const std::array<int, 3> &cells);

}    // namespace LAMMPS_NS

#endif
