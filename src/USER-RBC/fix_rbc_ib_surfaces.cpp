#include "fix_rbc_ib.h"

#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "force.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

// Markers that are surfaces: gaps between them, their tractions, the viscosity inside.

/* ---------------------------------------------------------------------- */

bool FixRBCIB::has_sheets() const
{
  if (sheets != Sheets::WITH_MEMBRANES) return sheets == Sheets::YES;
  return !masses && !all_cell_membranes(lmp).empty();
}

fluid::MarkerKind FixRBCIB::marker_kind() const
{
  if (contrast.acts()) return fluid::MarkerKind::layers;
  return has_sheets() ? fluid::MarkerKind::sheets : fluid::MarkerKind::points;
}

bool FixRBCIB::has_layers(double viscosity) const
{
  const auto membranes = all_cell_membranes(lmp);
  return std::any_of(membranes.begin(), membranes.end(), [viscosity](const CellMembranes *cells) {
    return cells->differs_inside(viscosity);
  });
}

/* ----------------------------------------------------------------------
   Points have no surfaces that could slide.
------------------------------------------------------------------------- */

void FixRBCIB::start_gaps(const std::vector<CellMembranes *> &membranes)
{
  if (gaps && has_sheets()) gaps->start_run(*flow, membranes, find_cell_contact(force));
  markers->set_gap_slip(slides_in_gaps() ? gaps.get() : nullptr);
  if (!asks_gaps || slides_in_gaps()) return;
  if (!has_sheets())
    error->all(FLERR, "Fix rbc/ib {} gaps yes needs a fix rbc/membrane, whose surfaces can slide",
               id);
  if (comm->me == 0)
    error->warning(FLERR,
                   "Fix rbc/ib {} gaps yes has no effect: there is no pair_style rbc/jkr, which "
                   "knows which surfaces are near, and there are no plates",
                   id);
}

void FixRBCIB::start_contrast(const std::vector<CellMembranes *> &membranes)
{
  contrast.start_run(flow, membranes, kernel, find_cell_contact(force));
  if (!contrast.acts()) return;
  if (flow->has_inertia())
    error->all(FLERR,
               "Fix rbc/membrane interior other than the viscosity of fix rbc/fluid {} needs its "
               "inertia none",
               fluid);
  if (!has_sheets())
    error->all(FLERR,
               "Fix rbc/membrane interior other than the viscosity of fix rbc/fluid {} needs fix "
               "rbc/ib {} with sheets yes",
               fluid, id);
}

void FixRBCIB::start_smoothing(const std::vector<CellMembranes *> &membranes)
{
  tractions.start_run(*flow, membranes);
  markers->set_traction_filter(tractions.acts() ? &tractions : nullptr);
  if (tractions.acts() && !has_sheets())
    error->all(FLERR,
               "Fix rbc/membrane smooth yes needs fix rbc/ib {} with sheets yes and scheme elastic",
               id);
}

bool FixRBCIB::slides_in_gaps() const
{
  return gaps && has_sheets() && gaps->acts();
}

double FixRBCIB::widest_gap() const
{
  const auto fluid_fix = dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid));
  if (!fluid_fix || !has_sheets()) return 0;
  DrivenFlow &of_fluid = fluid_fix->driven_flow();
  double widest = gaps ? gaps->widest_gap(of_fluid) : 0;
  if (has_layers(of_fluid.settings().equations.viscosity))
    widest = std::max(widest, contrast.widest_gap(of_fluid, kernel));
  return widest;
}
