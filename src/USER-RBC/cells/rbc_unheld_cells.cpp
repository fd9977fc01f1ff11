#include "cells/rbc_unheld_cells.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "error.h"
#include "molecule.h"
#include "support/rbc_gather.h"

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
  tagint first = 0;
  int cells = 0;
  for (const MoleculeSize &size : gather_molecules(std::move(mine), lmp->world)) {
    if (sizes.count(size.atoms) == 0) continue;
    if (++cells == 1) first = size.molecule;
  }
  if (cells == 0 || lmp->comm->me != 0) return;
  lmp->error->warning(FLERR,
                      "{} moves {} cell{} without a membrane (the first has molecule ID {}): no "
                      "group of a fix rbc/membrane holds the vertices",
                      style, cells, cells > 1 ? "s" : "", first);
}
