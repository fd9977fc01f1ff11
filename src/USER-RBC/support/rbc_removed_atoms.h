#ifndef LMP_RBC_REMOVED_ATOMS_H
#define LMP_RBC_REMOVED_ATOMS_H

#include <vector>

namespace LAMMPS_NS {

class LAMMPS;

/// Removes this rank's atoms that are marked, a number for each, with the bonds, angles, dihedrals
/// and impropers that they keep. Whole molecules must be marked. IDs of other atoms stay as they
/// are. Before atoms migrate; collective.
void remove_atoms(LAMMPS *lmp, std::vector<char> marked);

}    // namespace LAMMPS_NS

#endif
