#include "cells/rbc_cell_changes.h"

#include "compute.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "support/rbc_pair_parts.h"

using namespace LAMMPS_NS;

bool LAMMPS_NS::is_fed(LAMMPS *lmp, int groupbit)
{
  for (Fix *fix : lmp->modify->get_fix_list())
    if (const auto *const source = dynamic_cast<CellSource *>(fix))
      if (source->fed_groupbit() == groupbit) return true;
  return false;
}

void LAMMPS_NS::tell_of_changed_cells(LAMMPS *lmp)
{
  const auto tell = [](auto *style) {
    if (auto *const watcher = dynamic_cast<CellWatcher *>(style)) watcher->cells_changed();
  };
  for (Fix *fix : lmp->modify->get_fix_list()) tell(fix);
  for (StepPart *pair : pair_step_parts(lmp->force)) tell(pair);
  for (Compute *compute : lmp->modify->get_compute_list()) tell(compute);
}
