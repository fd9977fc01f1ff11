#include "fix_rbc_membrane.h"

#include "atom.h"
#include "cells/rbc_cell_template.h"
#include "cells/rbc_group_cells.h"
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
    cells(lmp, fmt::format("Fix rbc/membrane {}", id), groupbit, parse(narg, arg)), end_of_run(lmp)
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
  rbc::MembraneParameters &elastic = settings.elastic;

  Arguments args(lmp, "fix rbc/membrane", narg, arg, 4);
  elastic.law = read_law(args);
  std::vector<Arguments::Keyword> keywords{
      {"bending", [&] { read_bending(args, elastic); }},
      {"area",
       [&] {
         elastic.global_area = args.not_negative("area kglobal");
         elastic.local_area = args.not_negative("area klocal");
       }},
      {"volume", [&] { read_volume(args, settings); }},
      {"swell",
       [&] {
         settings.swelling = Swelling(args.number_or_variable(), lmp);
         if (!(settings.swelling.varies() || settings.swelling.now() > 0))
           args.fail("Fix rbc/membrane swell value {} must be > 0", settings.swelling.now());
       }},
      {"stress-free",
       [&] {
         take_stress_free_shape(lmp, *settings.surface, arg[3], args.text(), "fix rbc/membrane");
       }},
      {"viscosity", [&] { settings.viscosity = read_viscosity(args); }},
      {"smooth", [&] { settings.smoothed = args.logical(); }},
      {"interior", [&] { settings.interior = args.positive("interior"); }}};
  for (Arguments::Keyword &keyword : limits(args, elastic)) keywords.push_back(keyword);
  args.read(keywords);
  check_settings(settings);
  return settings;
}

/* ---------------------------------------------------------------------- */

std::vector<Arguments::Keyword> FixRBCMembrane::limits(Arguments &args,
                                                       rbc::MembraneParameters &elastic)
{
  return {{"crease",
           [&] {
             elastic.crease.stiffness = args.not_negative("crease k");
             const double angle = args.positive("crease angle");
             if (angle >= 180)
               args.fail("Fix rbc/membrane crease angle value {} must be below 180 degrees", angle);
             elastic.crease.cosine = cos(angle * MathConst::DEG2RAD);
           }},
          {"stretch", [&] {
             elastic.stretch.stiffness = args.not_negative("stretch k");
             const double stretch = args.positive("stretch lambda");
             if (stretch <= 1)
               args.fail("Fix rbc/membrane stretch lambda value {} must be above 1", stretch);
             elastic.stretch.i1 = stretch * stretch + 1 / (stretch * stretch);
           }}};
}

void FixRBCMembrane::check_settings(const MembraneSettings &settings) const
{
  const rbc::MembraneParameters &elastic = settings.elastic;
  const Swelling &swelling = settings.swelling;
  check_crease(elastic);
  if ((swelling.varies() || swelling.now() != 1) && !settings.volume_kept && elastic.volume == 0)
    error->all(FLERR, "Fix rbc/membrane swell needs volume yes or a modulus of the volume");
}

void FixRBCMembrane::check_crease(const rbc::MembraneParameters &elastic) const
{
  if (elastic.crease.stiffness > 0 && elastic.bending == 0)
    error->all(FLERR, "Fix rbc/membrane crease needs a bending modulus > 0");
}

rbc::SheetLaw FixRBCMembrane::read_law(Arguments &args)
{
  const std::string word = args.text();
  const std::size_t index = rbc::law_index<rbc::SheetLaw>(word);
  if (index == std::variant_size_v<rbc::SheetLaw>)
    args.fail("Unknown fix rbc/membrane law {}; allowed: {}", word,
              rbc::law_names<rbc::SheetLaw>());
  args.enter(word);
  std::vector<double> values;
  for (const rbc::LawParameter &parameter : rbc::law_parameters<rbc::SheetLaw>(index)) {
    const std::string name = word + ' ' + parameter.name;
    values.push_back(parameter.bound == rbc::Bound::positive ? args.positive(name)
                                                             : args.not_negative(name));
  }
  return rbc::make_law<rbc::SheetLaw>(index, values);
}

/* ----------------------------------------------------------------------
   a modulus, then one of reference or c0 and one of helfrich or dihedral, in any order
------------------------------------------------------------------------- */

void FixRBCMembrane::read_bending(Arguments &args, rbc::MembraneParameters &elastic)
{
  elastic.bending = args.not_negative();
  bool curved = false, formed = false;
  const auto once = [&](bool &given) {
    if (given)
      args.fail("Fix rbc/membrane bending value {} is one too many: allowed are one of reference "
                "or c0, and one of helfrich or dihedral",
                args.word());
    given = true;
  };
  while (true) {
    if (args.take("helfrich")) {
      once(formed);
      elastic.bending_form = rbc::BendingForm::helfrich;
    } else if (args.take("dihedral")) {
      once(formed);
      elastic.bending_form = rbc::BendingForm::dihedral;
    } else if (args.take("reference"))
      once(curved);
    else if (args.next_is_number()) {
      elastic.spontaneous_curvature = args.number();
      once(curved);
      elastic.reference_curvature = false;
    } else
      return;
  }
}

void FixRBCMembrane::read_volume(Arguments &args, MembraneSettings &settings)
{
  settings.elastic.volume = 0;
  settings.volume_kept = args.take("yes");
  if (settings.volume_kept || args.take("no")) return;
  if (args.next_is_number()) {
    settings.elastic.volume = args.not_negative();
    return;
  }
  const std::string value = args.text();
  args.fail("Fix rbc/membrane volume value {} must be yes, no or a modulus", value);
}

rbc::SurfaceViscosity FixRBCMembrane::read_viscosity(Arguments &args)
{
  const double at_rest = args.not_negative();
  if (!args.take("thinning")) return at_rest;
  args.enter("thinning");
  const double fast = args.not_negative("viscosity thinning eta_inf");
  if (fast > at_rest)
    args.fail("Fix rbc/membrane viscosity thinning eta_inf value {} must be <= eta_m, {}", fast,
              at_rest);
  return {at_rest, fast, args.positive("viscosity thinning rate")};
}

/* ---------------------------------------------------------------------- */

int FixRBCMembrane::setmask()
{
  return POST_NEIGHBOR | POST_FORCE | END_OF_STEP | POST_RUN;
}

/* ---------------------------------------------------------------------- */

int FixRBCMembrane::modify_param(int narg, char **arg)
{
  rbc::MembraneParameters changed = cells.parameters();
  Arguments args(lmp, "fix rbc/membrane", narg, arg);
  const int read = args.read_known(limits(args, changed));
  if (read == 0) return 0;
  check_crease(changed);
  cells.limit(changed.crease, changed.stretch);
  return read;
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::init()
{
  if (domain->triclinic)
    error->all(FLERR, "Fix rbc/membrane requires an orthogonal simulation box");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/membrane cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/membrane cannot be used with minimize");
  if (cells.is_smoothed() && modify->get_fix_by_style("^rbc/ib$").empty() && comm->me == 0)
    error->warning(FLERR,
                   "Fix rbc/membrane {} smooth yes has no effect: there is no fix rbc/ib, whose "
                   "fluid feels tractions",
                   id);
  if (cells.interior_viscosity() > 0 && modify->get_fix_by_style("^rbc/ib$").empty())
    error->all(FLERR,
               "Fix rbc/membrane {} interior needs a fix rbc/ib, whose fluid fills the cells", id);
  cells.start_run();
  check_apart();
  ask_for_ghosts();
  keep_cells_together();
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

/* ----------------------------------------------------------------------
   LAMMPS sorts atoms by bins. In bins as large as the largest cells most vertices of a cell stay
   neighbors in memory, and cells that are near each other come one after the other. Without a pair
   style LAMMPS does not sort, and need not.
------------------------------------------------------------------------- */

void FixRBCMembrane::keep_cells_together()
{
  if (!force->pair || atom->sortfreq == 0 || atom->userbinsize > 0) return;
  for (const CellMembranes *membranes : all_cell_membranes(lmp))
    atom->userbinsize =
        std::max(atom->userbinsize, std::sqrt(membranes->shape().area / MathConst::MY_PI));
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::setup_post_neighbor()
{
  cells.update_ownership();
  cells.warn_of_torn_cells();
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

void FixRBCMembrane::end_of_step()
{
  cells.note_areas();
}

void FixRBCMembrane::post_run()
{
  end_of_run.set();
  cells.warn_of_large_areas();
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
  if (n == 4) {
    if (!cells.is_viscous()) return 0;
    check_atoms_are_those_of_last_run(lmp, cells.style(), all_cell_membranes(lmp));
    return cells.viscous_power();
  }
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
