#include "pair_rbc_jkr.h"

#include "atom.h"
#include "cells/rbc_boundary_contact.h"
#include "cells/rbc_contact_coefficients.h"
#include "cells/rbc_near_surfaces.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "modify.h"

using namespace LAMMPS_NS;

// What pair rbc/jkr has to do with the fluid: who ends its steps, the unit of its lengths, and the
// plates and walls that repel cells.

void PairRBCJKR::report_to(const std::shared_ptr<CollectiveStop> &stop)
{
  surfaces->report_to(stop);
}

/* ---------------------------------------------------------------------- */

static const DrivenFlow *find_flow(Modify *modify)
{
  for (Fix *fix : modify->get_fix_by_style("^rbc/fluid$"))
    if (auto *const fluid = dynamic_cast<FixRBCFluid *>(fix)) return &fluid->driven_flow();
  return nullptr;
}

/* ----------------------------------------------------------------------
   The fluid's grid is chosen when its fix is defined, which may be after pair_style.
------------------------------------------------------------------------- */

void PairRBCJKR::init_lengths()
{
  const DrivenFlow *const flow = given.in_spacings ? find_flow(modify) : nullptr;
  if (given.in_spacings && !flow)
    error->all(FLERR, "Pair rbc/jkr units dx: there is no fix rbc/fluid, whose spacing dx means; "
                      "allowed without one: units box");
  unit = flow ? flow->smallest_spacing() : 1;
  cutoff = given.cutoff * unit;
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::init_boundaries()
{
  boundaries->init(given.plates, given.walls);
  if (!given.has_boundaries()) return;
  if (given.plates) {
    const DrivenFlow *const flow = find_flow(modify);
    if (!flow || !flow->settings().plates)
      error->all(FLERR,
                 "Pair rbc/jkr plates yes: there is no fix rbc/fluid with plates; allowed without "
                 "one: walls REGION in a vessel (before dense.blood: variable surfaces string "
                 "\"walls REGION\"), or plates no");
  }
  for (int i = 1; i <= atom->ntypes; ++i)
    if (setflag[i][i] && coefficients->touch(i, i)) return;
  error->all(FLERR,
             "Pair rbc/jkr {}: no atom type has a law with itself, by which it would be repelled; "
             "use pair_coeff adhesive or repulsive",
             boundaries->names());
}

std::string PairRBCJKR::repelling_boundaries(int itype) const
{
  return boundaries->range(itype) > 0 ? boundaries->names() : "";
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::log_boundaries() const
{
  if (given.in_spacings)
    utils::logmesg(lmp, "Pair rbc/jkr: cutoff and R are in spacings of the fluid's grid, {:.6g}\n",
                   unit);
  for (int i = 1; i <= atom->ntypes; ++i)
    if (!repelling_boundaries(i).empty())
      utils::logmesg(lmp, "Pair rbc/jkr, type {}: repelled by {} from a gap of {:.6g} on\n", i,
                     repelling_boundaries(i), boundaries->range(i));
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::add_forces_of_boundaries()
{
  for (const auto &contact : boundaries->contacts(surfaces->stopper())) {
    const double normal[3] = {contact.normal.x, contact.normal.y, contact.normal.z};
    for (int d = 0; d < 3; ++d) atom->f[contact.vertex][d] += contact.force * normal[d];
    if (evflag) tally(contact.vertex, contact.energy, contact.force * contact.gap, normal);
  }
  if (!given.walls.empty()) surfaces->stopper().check();
}
