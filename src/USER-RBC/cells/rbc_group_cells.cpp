#include "cells/rbc_group_cells.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "support/rbc_gather.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

void GroupCells::find(int groupbit)
{
  members = all_cell_membranes(lmp);
  if (members.empty()) error->all(FLERR, "{} needs a fix rbc/membrane: it knows the cells", owner);

  for (CellMembranes *membranes : members)
    membranes->local_cells().identify();    // the fix itself may be initialised later
  collect(groupbit);
}

void GroupCells::collect(int groupbit)
{
  ids.clear();
  for (CellMembranes *membranes : members) {
    const auto molecules = gather_all(membranes->local_cells().all().kept(), world);
    ids.insert(ids.end(), molecules.begin(), molecules.end());
  }
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end())
    error->all(FLERR, "{}: molecule ID {} belongs to more than one fix rbc/membrane", owner,
               *twice);

  std::vector<int> outside(ids.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int index = cell_of(i);
    if (index >= 0 && !(atom->mask[i] & groupbit)) outside[index] = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, outside.data(), static_cast<int>(outside.size()), MPI_INT, MPI_MAX,
                world);
  std::vector<tagint> inside;
  for (std::size_t n = 0; n < ids.size(); ++n)
    if (!outside[n]) inside.push_back(ids[n]);
  ids = std::move(inside);
}

int GroupCells::cell_of(int i) const
{
  for (const CellMembranes *membranes : members)
    if (atom->mask[i] & membranes->groupbit()) return index_of(atom->molecule[i]);
  return -1;
}

int GroupCells::index_of(tagint molecule) const
{
  const auto found = std::lower_bound(ids.begin(), ids.end(), molecule);
  return found != ids.end() && *found == molecule ? static_cast<int>(found - ids.begin()) : -1;
}

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::check_atoms_are_those_of_last_run(LAMMPS *lmp, const std::string &style,
                                                  const std::vector<CellMembranes *> &known)
{
  if (lmp->update->whichflag != 0) return;
  int changed = known != all_cell_membranes(lmp) ? 1 : 0;
  for (Fix *fix : lmp->modify->get_fix_list())
    if (const auto *const owner = dynamic_cast<MembraneOwner *>(fix))
      changed |= owner->are_atoms_others() ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, lmp->world);
  if (changed)
    lmp->error->all(FLERR,
                    "{}: atoms, the box or fixes rbc/membrane have changed since the last run, so "
                    "that cells are not known; use run 0 first",
                    style);
}
