#include "fix_rbc_membrane.h"

#include "atom.h"
#include "cells/rbc_cell_template.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "math_const.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixRBCMembrane::FixRBCMembrane(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), ghosts(lmp),
    cells(lmp, fmt::format("Fix rbc/membrane {}", id), groupbit, parse(narg, arg))
{
  scalar_flag = vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  extscalar = extvector = 1;
  energy_global_flag = 1;
  virial_global_flag = 1;
  restart_global = cells.swelling().varies() ? 1 : 0;
}

/* ---------------------------------------------------------------------- */

MembraneSettings FixRBCMembrane::parse(int narg, char **arg)
{
  if (narg < 5) utils::missing_cmd_args(FLERR, "fix rbc/membrane", error);
  MembraneSettings settings;
  settings.surface = make_cell_template(lmp, arg[3], "fix rbc/membrane");
  rbc::MembraneParameters &parameters = settings.elastic;
  rbc::SurfaceViscosity &viscosity = settings.viscosity;
  Swelling &swelling = settings.swelling;
  int iarg = 4;
  const auto need = [&](int n, const std::string &keyword) {
    if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "fix rbc/membrane " + keyword, error);
  };
  const auto not_negative = [&](int at, const std::string &name) {
    const double value = utils::numeric(FLERR, arg[at], false, lmp);
    if (!(value >= 0))
      error->all(FLERR, at, "Fix rbc/membrane {} value {} must be >= 0", name, arg[at]);
    return value;
  };
  const auto positive = [&](int at, const std::string &name) {
    const double value = not_negative(at, name);
    if (value == 0)
      error->all(FLERR, at, "Fix rbc/membrane {} value {} must be > 0", name, arg[at]);
    return value;
  };

  const std::string law = arg[iarg];
  const std::size_t index = rbc::law_index<rbc::SheetLaw>(law);
  if (index == std::variant_size_v<rbc::SheetLaw>)
    error->all(FLERR, iarg, "Unknown fix rbc/membrane law {}; allowed: {}", law,
               rbc::law_names<rbc::SheetLaw>());
  const auto law_parameters = rbc::law_parameters<rbc::SheetLaw>(index);
  need(static_cast<int>(law_parameters.size()), law);
  std::vector<double> values;
  for (const rbc::LawParameter &parameter : law_parameters) {
    const std::string name = law + ' ' + parameter.name;
    ++iarg;
    values.push_back(parameter.bound == rbc::Bound::positive ? positive(iarg, name)
                                                             : not_negative(iarg, name));
  }
  ++iarg;
  parameters.law = rbc::make_law<rbc::SheetLaw>(index, values);

  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    if (keyword == "bending") {
      need(1, keyword);
      parameters.bending = not_negative(iarg + 1, keyword);
      iarg += 2;
      bool curved = false, formed = false;
      for (; iarg < narg; ++iarg) {
        const std::string value = arg[iarg];
        const bool is_form = value == "helfrich" || value == "dihedral";
        if (!is_form && value != "reference" && !utils::is_double(value)) break;
        if (is_form ? formed : curved)
          error->all(
              FLERR, iarg,
              "Fix rbc/membrane bending value {} is one too many: allowed are one of reference "
              "or c0, and one of helfrich or dihedral",
              value);
        (is_form ? formed : curved) = true;
        if (is_form)
          parameters.bending_form =
              value == "dihedral" ? rbc::BendingForm::dihedral : rbc::BendingForm::helfrich;
        else if (value != "reference") {
          parameters.reference_curvature = false;
          parameters.spontaneous_curvature = utils::numeric(FLERR, arg[iarg], false, lmp);
        }
      }
    } else if (keyword == "crease") {
      need(2, keyword);
      parameters.crease.stiffness = not_negative(iarg + 1, "crease k");
      const double angle = positive(iarg + 2, "crease angle");
      if (angle >= 180)
        error->all(FLERR, iarg + 2,
                   "Fix rbc/membrane crease angle value {} must be below 180 degrees",
                   arg[iarg + 2]);
      parameters.crease.cosine = cos(angle * MathConst::DEG2RAD);
      iarg += 3;
    } else if (keyword == "stretch") {
      need(2, keyword);
      parameters.stretch.stiffness = not_negative(iarg + 1, "stretch k");
      const double stretch = positive(iarg + 2, "stretch lambda");
      if (stretch <= 1)
        error->all(FLERR, iarg + 2, "Fix rbc/membrane stretch lambda value {} must be above 1",
                   arg[iarg + 2]);
      parameters.stretch.i1 = stretch * stretch + 1 / (stretch * stretch);
      iarg += 3;
    } else if (keyword == "area") {
      need(2, keyword);
      parameters.global_area = not_negative(iarg + 1, "area kglobal");
      parameters.local_area = not_negative(iarg + 2, "area klocal");
      iarg += 3;
    } else if (keyword == "volume") {
      need(1, keyword);
      const std::string value = arg[iarg + 1];
      settings.volume_kept = value == "yes";
      parameters.volume = 0;
      if (value != "yes" && value != "no") {
        if (!utils::is_double(value))
          error->all(FLERR, iarg + 1,
                     "Fix rbc/membrane volume value {} must be yes, no or a modulus", value);
        parameters.volume = not_negative(iarg + 1, keyword);
      }
      iarg += 2;
    } else if (keyword == "viscosity") {
      need(1, keyword);
      const double at_rest = not_negative(iarg + 1, keyword);
      viscosity = at_rest;
      iarg += 2;
      if (iarg < narg && strcmp(arg[iarg], "thinning") == 0) {
        need(2, "viscosity thinning");
        const double fast = not_negative(iarg + 1, "viscosity thinning eta_inf");
        if (fast > at_rest)
          error->all(FLERR, iarg + 1,
                     "Fix rbc/membrane viscosity thinning eta_inf value {} must be <= eta_m, {}",
                     arg[iarg + 1], arg[iarg - 1]);
        viscosity = {at_rest, fast, positive(iarg + 2, "viscosity thinning rate")};
        iarg += 3;
      }
    } else if (keyword == "swell") {
      need(1, keyword);
      swelling = Swelling(lmp, arg[iarg + 1]);
      if (!swelling.varies()) positive(iarg + 1, keyword);
      iarg += 2;
    } else if (keyword == "stress-free") {
      need(1, keyword);
      take_stress_free_shape(lmp, *settings.surface, arg[3], arg[iarg + 1], "fix rbc/membrane");
      iarg += 2;
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/membrane keyword {}; allowed: bending, area, volume, swell, "
                 "stress-free, viscosity, crease, stretch",
                 keyword);
  }
  if (parameters.crease.stiffness > 0 && parameters.bending == 0)
    error->all(FLERR, "Fix rbc/membrane crease needs a bending modulus > 0");
  if ((swelling.varies() || swelling.now() != 1) && !settings.volume_kept && parameters.volume == 0)
    error->all(FLERR, "Fix rbc/membrane swell needs volume yes or a modulus of the volume");
  return settings;
}

/* ---------------------------------------------------------------------- */

int FixRBCMembrane::setmask()
{
  return POST_NEIGHBOR | POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::init()
{
  if (domain->triclinic)
    error->all(FLERR, "Fix rbc/membrane requires an orthogonal simulation box");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/membrane cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/membrane cannot be used with minimize");
  cells.start_run();
  check_apart();
  ask_for_ghosts();
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::check_apart() const
{
  for (Fix *other : modify->get_fix_by_style("^rbc/membrane$")) {
    if (other == this) break;
    int shared = 0;
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit)) shared = 1;
    MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, world);
    if (shared)
      error->all(FLERR, "Fix rbc/membrane {} and {} share atoms: a cell belongs to one of them",
                 other->id, id);
  }
}

/* ----------------------------------------------------------------------
   the ghost cutoff is one for all fixes rbc/membrane, and LAMMPS warns if it is below that of pairs
------------------------------------------------------------------------- */

void FixRBCMembrane::ask_for_ghosts()
{
  if (ghosts.is_given_by_user()) return;
  double reach = 0;
  for (const CellMembranes *membranes : all_cell_membranes(lmp))
    reach = std::max(reach, membranes->ghost_reach());
  if (force->pair) reach = std::max(reach, force->pair->cutforce);
  ghosts.ask_for(reach + neighbor->skin);
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::setup_post_neighbor()
{
  cells.update_ownership();
}

void FixRBCMembrane::post_neighbor()
{
  cells.update_ownership();
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::setup(int vflag)
{
  cells.update_swelling(true);
  post_force(vflag);
}

void FixRBCMembrane::post_force(int vflag)
{
  v_init(vflag);
  CellMembranes::VirialTally tally;
  if (evflag) tally = [this](int vertex, double *virial_of) { v_tally(vertex, virial_of); };
  cells.tally_virial(tally);
  cells.add_forces();
  energy_step = -1;
}

/* ---------------------------------------------------------------------- */

const rbc::MembraneEnergy &FixRBCMembrane::total_energy()
{
  if (energy_step != update->ntimestep) energy = cells.energy();
  energy_step = update->ntimestep;
  return energy;
}

double FixRBCMembrane::compute_scalar()
{
  return total_energy().total();
}

/* ----------------------------------------------------------------------
   energies of 1 sheet, 2 bending, 3 area, 4 volume; 5 power dissipated by the membranes' viscosity
------------------------------------------------------------------------- */

double FixRBCMembrane::compute_vector(int n)
{
  if (n == 4) return cells.is_viscous() ? cells.viscous_power() : 0;
  const rbc::MembraneEnergy &parts = total_energy();
  const double part[4] = {parts.sheet, parts.bending, parts.area, parts.volume};
  return part[n];
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  const int size = sizeof(Swelling::State);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(&cells.swelling().state, size, 1, fp);
}

void FixRBCMembrane::restart(char *buffer)
{
  Swelling &swelling = cells.swelling();
  if (swelling.varies()) memcpy(&swelling.state, buffer, sizeof(Swelling::State));
}

/* ---------------------------------------------------------------------- */

double FixRBCMembrane::memory_usage()
{
  return cells.bytes();
}
