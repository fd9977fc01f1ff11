#include "fix_rbc_ib.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "coupling/rbc_wall_group.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "support/rbc_pair_parts.h"
#include "update.h"

#include <algorithm>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;

// What fix rbc/ib refuses, and what it advises where a run goes wrong.

/* ---------------------------------------------------------------------- */

void FixRBCIB::check_run() const
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/ib cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/ib cannot be used with minimize");
}

void FixRBCIB::check_inertia() const
{
  const bool inertia = flow->has_inertia();
  if (inertia && !steps->integrator().allows_inertia()) {
    std::string words;
    for (const rbc::IntegratorKind &kind : rbc::integrator_kinds)
      if (kind.make({})->allows_inertia())
        words += (words.empty() ? "" : " or ") + std::string(kind.word);
    error->all(FLERR,
               "Fix rbc/ib {}: fix rbc/fluid {} has inertia, for which integrator must be {}", id,
               fluid, words);
  }
  if (inertia && steps->adaptive())
    error->all(FLERR, "Fix rbc/ib {} adapt needs fix rbc/fluid {} inertia none", id, fluid);
  if (!masses) return;
  if (!inertia)
    error->all(FLERR,
               "Fix rbc/ib {} scheme direct needs a fluid with inertia: fix rbc/fluid {} "
               "inertia unsteady or convective",
               id, fluid);
  if (flow->flow().equations().scheme != fluid::Scheme::coupled)
    error->all(FLERR, "Fix rbc/ib {} scheme direct needs fix rbc/fluid {} scheme coupled", id,
               fluid);
}

void FixRBCIB::warn_of_default_timestep() const
{
  if (!update->dt_default || steps->adaptive() || comm->me != 0) return;
  error->warning(
      FLERR,
      "Fix rbc/ib {}: no timestep was given, so it is LAMMPS's own for units {}, {:.6g}; "
      "use the timestep command, or adapt",
      id, update->unit_style, update->dt);
}

/* ----------------------------------------------------------------------
   Tells whether fixes defined after this one add forces, which setup() does not see.
------------------------------------------------------------------------- */

bool FixRBCIB::check_order() const
{
  bool before = true, late_forces = false;
  for (Fix *fix : modify->get_fix_list()) {
    if (fix == this) before = false;
    if (before && steps->adaptive() && (modify->get_fix_mask(fix) & INITIAL_INTEGRATE) &&
        !dynamic_cast<FixRBCFluid *>(fix))
      error->all(
          FLERR,
          "Fix rbc/ib {} with adapt must be defined before fix {} {}, which moves atoms by the "
          "timestep",
          id, fix->style, fix->id);
    if (!before && (modify->get_fix_mask(fix) & POST_FORCE)) late_forces = true;
    if (!before && dynamic_cast<MembraneOwner *>(fix))
      error->all(FLERR, "Fix rbc/ib {} must be defined after fix rbc/membrane {}", id, fix->id);
  }
  return late_forces;
}

/* ----------------------------------------------------------------------
   Keeping a cell's volume changes the velocities of all its vertices, and the viscosity of its
   membrane depends on them.  Smoothing passes forces from vertex to vertex: those that a wall holds
   would keep their share from the fluid.  The double layer of a cell is that of a closed surface.
------------------------------------------------------------------------- */

void FixRBCIB::check_moves_all(const CellMembranes &cells) const
{
  int left_out = 0;
  int moved = groupbit;    // or held
  for (FluidClient *client : fluid_clients(modify))
    if (client->wall_group() && !cells.is_smoothed() && !contrast.acts_on(cells))
      moved |= client->wall_group()->groupbit();
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & cells.groupbit()) && !(atom->mask[i] & moved)) left_out = 1;
  MPI_Allreduce(MPI_IN_PLACE, &left_out, 1, MPI_INT, MPI_MAX, world);
  if (left_out)
    error->all(FLERR, "Fix rbc/ib {} does not move all atoms of f{}, which {}", id,
               cells.style().substr(1),
               cells.is_smoothed()       ? "smooths tractions"
               : contrast.acts_on(cells) ? "has another viscosity inside"
               : cells.keeps_volume()    ? "keeps the volume of its cells"
                                         : "has viscosity");
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::check_apart(const WallGroup &wall) const
{
  int shared = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & wall.groupbit()) && (atom->mask[i] & groupbit)) shared = 1;
  MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, world);
  if (shared)
    error->all(FLERR,
               "Fix rbc/ib {} would move atoms of f{}: their groups must have no atoms in common",
               id, wall.style().substr(1));
}

/* ----------------------------------------------------------------------
   of the fluid, with which cells of another viscosity inside are two fluid cells thick; 0 if they
   are
------------------------------------------------------------------------- */

double FixRBCIB::spacing_for_insides() const
{
  double finer = 0;
  for (CellMembranes *membranes : all_cell_membranes(lmp)) {
    if (!flow || !contrast.acts_on(*membranes)) continue;
    const double half = membranes->thickness() / 2;
    if (half < flow->mean_spacing()) finer = finer > 0 ? std::min(finer, half) : half;
  }
  return finer;
}

/* ----------------------------------------------------------------------
   Returns, in words, the fixes of LAMMPS that add forces to atoms which this fix moves. Collective.
------------------------------------------------------------------------- */

std::string FixRBCIB::pushing_fixes() const
{
  std::vector<Fix *> others;
  for (Fix *fix : modify->get_fix_list())
    if ((modify->get_fix_mask(fix) & POST_FORCE) && !utils::strmatch(fix->style, "^rbc/"))
      others.push_back(fix);
  std::vector<int> pushes(others.size());
  for (std::size_t n = 0; n < others.size(); ++n)
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & groupbit) && (atom->mask[i] & others[n]->groupbit)) pushes[n] = 1;
  MPI_Allreduce(MPI_IN_PLACE, pushes.data(), static_cast<int>(pushes.size()), MPI_INT, MPI_MAX,
                world);
  std::string fixes;
  for (std::size_t n = 0; n < others.size(); ++n)
    if (pushes[n])
      fixes +=
          fmt::format("{}fix {} {}", fixes.empty() ? "" : ", ", others[n]->style, others[n]->id);
  return fixes;
}

/* ---------------------------------------------------------------------- */

std::string FixRBCIB::remedies_for(const std::vector<Flaw> &seen)
{
  Situation now;
  now.inertia = flow && flow->has_inertia();
  now.chooses_stages = steps->integrator().can_retake();
  now.adapts = steps->adaptive();
  now.creases = now.limits_stretch = true;
  bigint cells = 0;
  for (const CellMembranes *membranes : all_cell_membranes(lmp)) {
    now.membranes = true;
    cells += membranes->local_cells().count();
    now.creases = now.creases && membranes->parameters().crease.stiffness > 0;
    now.limits_stretch = now.limits_stretch && membranes->parameters().stretch.stiffness > 0;
  }
  now.finer_spacing = spacing_for_insides();
  now.several_cells = cells > 1;
  now.lacks_contact = now.several_cells && pair_step_parts(force).empty();
  if (force->pair && !utils::strmatch(force->pair_style, "^zero") &&
      !utils::strmatch(force->pair_style, "^rbc/"))
    now.pair_of_atoms = force->pair_style;
  now.pushing = pushing_fixes();
  now.timestep = update->dt;
  now.ghost_cutoff = comm->get_comm_cutoff();
  now.skin = neighbor->skin;
  return remedies(seen, now);
}
