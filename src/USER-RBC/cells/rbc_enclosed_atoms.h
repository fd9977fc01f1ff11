#ifndef LMP_RBC_ENCLOSED_ATOMS_H
#define LMP_RBC_ENCLOSED_ATOMS_H

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

/// Collective, when all membranes know which vertices are here: warns if atoms of a group that are
/// no vertices of cells lie inside a cell. `style` names the fix that moves the group. Atoms that
/// are further from the centre of a cell than the diameter of its template are not looked at.
void warn_of_enclosed_atoms(LAMMPS *lmp, const std::string &style, int groupbit);

}    // namespace LAMMPS_NS

#endif
