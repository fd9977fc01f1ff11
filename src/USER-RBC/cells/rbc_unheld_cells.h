#ifndef LMP_RBC_UNHELD_CELLS_H
#define LMP_RBC_UNHELD_CELLS_H

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

/// Collective: warns if atoms of a group look like cells, but are in no group of a fix
/// rbc/membrane: molecules of as many atoms as a molecule template of triangles has vertices.
/// `style` names the fix that moves the group.
void warn_of_unheld_cells(LAMMPS *lmp, const std::string &style, int groupbit);

}    // namespace LAMMPS_NS

#endif
