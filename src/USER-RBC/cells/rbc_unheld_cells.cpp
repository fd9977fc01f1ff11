#include "cells/rbc_unheld_cells.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "error.h"
#include "molecule.h"
#include "support/rbc_molecule_shares.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

using namespace LAMMPS_NS;

namespace {

struct MoleculeSize {
  tagint molecule;
  bigint atoms;

  void include(const MoleculeSize &other) { atoms += other.atoms; }
};

/// Vertices of the molecule templates that have triangles.
std::set<bigint> cell_sizes(const Atom *atom)
{
  std::set<bigint> sizes;
  for (int n = 0; n < atom->nmolecule; ++n)
    if (atom->molecules[n]->angleflag) sizes.insert(atom->molecules[n]->natoms);
  return sizes;
}

}    // namespace

void LAMMPS_NS::warn_of_unheld_cells(LAMMPS *lmp, const std::string &style, int groupbit)
{
  const Atom *const atom = lmp->atom;
  const std::set<bigint> sizes = cell_sizes(atom);
  if (sizes.empty() || !atom->molecule_flag) return;
  int held = 0;
  for (const CellMembranes *membranes : all_cell_membranes(lmp)) held |= membranes->groupbit();

  std::vector<MoleculeSize> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & groupbit) && !(atom->mask[i] & held) && atom->molecule[i] > 0)
      mine.push_back({atom->molecule[i], 1});
  tagint first = MAXTAGINT;
  bigint cells = 0;
  for (const MoleculeSize &size : share_molecules(lmp, std::move(mine))) {
    if (sizes.count(size.atoms) == 0) continue;
    first = std::min(first, size.molecule);
    ++cells;
  }
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LMP_TAGINT, MPI_MIN, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, &cells, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (cells == 0 || lmp->comm->me != 0) return;
  lmp->error->warning(FLERR,
                      "{} moves {} cell{} without a membrane (the first has molecule ID {}): no "
                      "group of a fix rbc/membrane holds the vertices",
                      style, cells, cells > 1 ? "s" : "", first);
}
