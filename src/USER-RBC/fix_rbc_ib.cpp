#include "fix_rbc_ib.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "cells/rbc_enclosed_atoms.h"
#include "cells/rbc_unheld_cells.h"
#include "comm.h"
#include "coupling/rbc_memory_table.h"
#include "coupling/rbc_motion_restart.h"
#include "coupling/rbc_wall_group.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "fix_store_atom.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "support/rbc_out_of_memory.h"
#include "support/rbc_pair_parts.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixRBCIB::FixRBCIB(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), tractions(lmp, *this), contrast(lmp), cost(lmp)
{
  time_integrate = 1;
  vector_flag = 1;
  size_vector = 12;
  global_freq = 1;
  extvector = 0;
  comm_forward = comm_reverse = 3;

  if (narg < 4) utils::missing_cmd_args(FLERR, "fix rbc/ib", error);
  fluid = arg[3];
  auto settings = MotionSettings::read(lmp, narg, arg, 4);
  takes_default = !settings.integrator && settings.options.order == 2;
  if (!settings.integrator)
    settings.integrator = default_integrator(settings.direct || fluid_has_inertia());
  settings.check(error);
  build(settings);

  if (stored() > 0) create_attribute = 1;
  restart_global = 1;
}

/* ----------------------------------------------------------------------
   Tells whether the fluid has inertia, if it is defined already. init() looks again.
------------------------------------------------------------------------- */

bool FixRBCIB::fluid_has_inertia() const
{
  const auto fluid_fix = dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid));
  return fluid_fix && fluid_fix->driven_flow().has_inertia();
}

/* ----------------------------------------------------------------------
   Chooses the default integrator anew where the fluid was defined after this fix.
------------------------------------------------------------------------- */

void FixRBCIB::update_default()
{
  if (!takes_default || masses || steps->integrator().allows_inertia() == flow->has_inertia())
    return;
  if (!flow->has_inertia())
    error->all(FLERR,
               "Fix rbc/ib {} was defined for a fluid with inertia, with integrator {}; fix "
               "rbc/fluid {} has none now: define the fix anew, or name an integrator",
               id, default_integrator(true)->word, fluid);
  if (steps->adaptive()) return;    // an error of its own
  steps->set_integrator(default_integrator(true)->make({}));
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::build(const MotionSettings &settings)
{
  sheets = settings.sheets;
  iterates = settings.iterates;
  asks_gaps = settings.asks_gaps;
  courant = settings.markers.courant;
  kernel = settings.markers.kernel;
  most_solves = settings.max_solves;
  integrator_code = settings.integrator->code;
  const std::string style = fmt::format("Fix rbc/ib {}", id);
  markers = std::make_unique<ImmersedMarkers>(lmp, style, groupbit, settings.markers);
  markers->implicit().set_limits(settings.tolerance, settings.max_solves);
  if (settings.gaps) gaps = std::make_unique<GapSlip>(lmp, *this, settings.markers.kernel);
  steps =
      std::make_unique<TimeSteps>(lmp, style, *markers, settings.integrator->make(settings.options),
                                  settings.error_bound, settings.largest_dt);
  if (!settings.direct) return;
  masses = std::make_unique<MassiveMarkers>(lmp);
  masses->set_limits(settings.tolerance, settings.max_solves);
  markers->set_masses(masses.get());
}

/* ----------------------------------------------------------------------
   numbers kept for each atom
------------------------------------------------------------------------- */

int FixRBCIB::stored() const
{
  return masses ? MassiveMarkers::COLUMNS : steps->columns();
}

/* ---------------------------------------------------------------------- */

FixRBCIB::~FixRBCIB()
{
  if (store && modify->nfix) modify->delete_fix(store_id);
}

/* ----------------------------------------------------------------------
   what is stored differs: a restart file of another method must not be taken for this one's
------------------------------------------------------------------------- */

void FixRBCIB::post_constructor()
{
  if (stored() == 0) return;
  constexpr int direct_code = 10;
  store_id = fmt::format("{}_STORE_{}_{}", id, masses ? direct_code : integrator_code, stored());
  store = dynamic_cast<FixStoreAtom *>(modify->add_fix(
      fmt::format("{} {} STORE/ATOM {} 0 0 1", store_id, group->names[igroup], stored())));
  if (masses)
    masses->keep_in(store);
  else
    steps->keep_in(store);
}

/* ----------------------------------------------------------------------
   a new atom has no past
------------------------------------------------------------------------- */

void FixRBCIB::set_arrays(int i)
{
  std::fill_n(store->astore[i], stored(), 0.0);
}

void FixRBCIB::cells_changed()
{
  steps->forget_velocities();
}

/* ---------------------------------------------------------------------- */

int FixRBCIB::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | POST_NEIGHBOR | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::init()
{
  const auto fluid_fix = dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid));
  if (!fluid_fix)
    error->all(FLERR, "Fix rbc/ib {}: there is no fix rbc/fluid with ID {}", id, fluid);
  flow = &fluid_fix->driven_flow();
  check_run();
  update_default();
  check_inertia();
  warn_of_default_timestep();

  std::vector<CellMembranes *> membranes = all_cell_membranes(lmp);
  const bool late_forces = check_order();
  start_contrast(membranes);
  bool viscous = false, filled = false;
  for (CellMembranes *cells : membranes) {
    cells->report_to(markers->stop());
    if (cells->keeps_volume() || cells->is_viscous() || cells->is_smoothed() ||
        contrast.acts_on(*cells))
      check_moves_all(*cells);
    viscous = viscous || cells->is_viscous();
    filled = filled || cells->interior_viscosity() > 0;
  }
  if (viscous && flow->has_inertia())
    error->all(FLERR, "Fix rbc/ib {}: membranes with viscosity need fix rbc/fluid {} inertia none",
               id, fluid);
  if (iterates && !masses && !viscous && !filled)
    error->all(FLERR, "Fix rbc/ib tol and maxiter need scheme direct or a fix rbc/membrane with "
                      "viscosity or interior");
  for (FluidClient *client : fluid_clients(modify))
    if (client->wall_group()) check_apart(*client->wall_group());
  for (StepPart *pair : pair_step_parts(force)) pair->report_to(markers->stop());
  warn_of_unheld_cells(lmp, fmt::format("Fix rbc/ib {}", id), groupbit);
  markers->stop()->shows_failure = true;

  markers->start_run(flow, membranes, marker_kind(), contrast.acts() ? &contrast : nullptr);
  start_gaps(membranes);
  start_smoothing(membranes);
  steps->start_run(flow, late_forces);
}

/* ----------------------------------------------------------------------
   exchange of numbers of ghosts
------------------------------------------------------------------------- */

void FixRBCIB::send_to_ghosts(AtomRows &rows)
{
  exchanged = &rows;
  comm->forward_comm(this);
}

void FixRBCIB::add_from_ghosts(AtomRows &rows)
{
  exchanged = &rows;
  comm->reverse_comm(this);
}

int FixRBCIB::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return exchanged->pack(n, list, buf);
}

void FixRBCIB::unpack_forward_comm(int n, int first, double *buf)
{
  exchanged->unpack(n, first, buf);
}

int FixRBCIB::pack_reverse_comm(int n, int first, double *buf)
{
  return exchanged->pack_reverse(n, first, buf);
}

void FixRBCIB::unpack_reverse_comm(int n, int *list, double *buf)
{
  exchanged->add_reverse(n, list, buf);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup_post_neighbor()
{
  post_neighbor();
}

void FixRBCIB::post_neighbor()
{
  markers->find_members();
  markers->implicit().forget_directions();
  if (!masses) steps->atoms_migrated();
  if (slides_in_gaps()) gaps->atoms_migrated();
  contrast.atoms_migrated();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup(int /*vflag*/)
{
  flow->set_time_at_setup();
  markers->implicit().reset_counts();
  if (masses)
    masses->reset_counts();
  else if (flow->has_inertia() && flow->flow().steps() == 0)
    markers->interpolate();
  do_or_run_out(lmp, fmt::format("Fix rbc/ib {}", id), [this] { steps->setup(); });
  warn_of_enclosed_atoms(lmp, fmt::format("Fix rbc/ib {}", id), groupbit);
  flow->scene().print(*flow);

  std::vector<StepPart *> parts;
  for (CellMembranes *cells : all_cell_membranes(lmp)) parts.push_back(cells);
  for (StepPart *pair : pair_step_parts(force)) parts.push_back(pair);
  parts.push_back(flow);
  parts.push_back(markers.get());
  if (slides_in_gaps()) parts.push_back(gaps.get());
  if (tractions.acts()) parts.push_back(&tractions);
  if (contrast.acts()) parts.push_back(&contrast);
  if (flow->walls()) parts.push_back(flow->walls());
  cost.start(parts);
  flow->count_from_here();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::initial_integrate(int /*vflag*/)
{
  steps->advance();
  if (masses) masses->accept(update->dt);
}

void FixRBCIB::final_integrate()
{
  steps->finish();
}

/* ----------------------------------------------------------------------
   1-3 force of the atoms on the fluid, 4 error of the coupling, 5 stages, 6 spectral radius, 7
   local error, 8 steps taken again, 9 timestep: of the last step; 10 of value 8 gone wrong; 11
   iterations of an evaluation in this run, 12 error left by the last
------------------------------------------------------------------------- */

double FixRBCIB::compute_vector(int n)
{
  switch (n) {
    case 3:
      return masses ? masses->error() : 0;
    case 4:
      return steps->integrator().stages();
    case 5:
      return steps->integrator().spectral_radius();
    case 6:
      return steps->local_error();
    case 7:
      return static_cast<double>(steps->rejected());
    case 8:
      return steps->last_dt();
    case 9:
      return static_cast<double>(steps->failed());
    case 10:
      return markers->implicit().mean_iterations();
    case 11:
      return markers->implicit().error();
  }
  double sum = 0;
  if (masses)
    sum = masses->exerted()[n] / force->ftm2v;
  else
    for (int i : markers->members()) sum += atom->f[i][n];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::write_restart(FILE *fp)
{
  MotionRestart(lmp, fmt::format("Fix rbc/ib {}", id), *steps, masses.get()).write(fp);
}

void FixRBCIB::restart(char *buffer)
{
  MotionRestart(lmp, fmt::format("Fix rbc/ib {}", id), *steps, masses.get()).restore(buffer);
}

/* ----------------------------------------------------------------------
   cost of a solve with all that belongs to it, summed over ranks
------------------------------------------------------------------------- */

void FixRBCIB::post_run()
{
  flow->finish_evaluation();    // atoms may be changed after the run
  const bigint solves = flow->solves_counted(), step_count = flow->steps_counted();
  if (solves == 0) return;
  const double cells = static_cast<double>(flow->flow().grid().size());
  const bigint vertices = markers->count();
  const std::string table = cost.table(solves, vertices, cells), costs = flow->costs();
  const std::string bytes = vertices > 0 ? MemoryTable(lmp).table(vertices) : "";
  if (comm->me != 0) return;

  std::string text =
      fmt::format("\nUSER-RBC step cost: {} solves in {} steps, {} vertices, {:.0f} "
                  "fluid cells, {} MPI task{}\n",
                  solves, step_count, vertices, cells, comm->nprocs, comm->nprocs > 1 ? "s" : "");
  text += table + costs + bytes;
  const double radius = steps->integrator().spectral_radius();
  if (radius > 0)
    text += fmt::format("Timestep times spectral radius: {:.4g}\n", steps->last_dt() * radius);
  if (steps->rejected() > 0)
    text += fmt::format("Steps taken again: {}, {} of them gone wrong\n", steps->rejected(),
                        steps->failed());
  if (steps->failed() > 0) text += fmt::format("The last: {}\n", steps->last_failure());
  utils::logmesg(lmp, text);
  warn();
}

void FixRBCIB::warn() const
{
  constexpr double MANY = 0.05;    // of all steps
  if (steps->adaptive() &&
      static_cast<double>(steps->failed()) > MANY * static_cast<double>(flow->steps_counted()))
    error->warning(FLERR,
                   "Fix rbc/ib {} took steps again because they had gone wrong, {} times in {} "
                   "steps: what goes wrong, and not the error, sets the timestep, and the line "
                   "above tells what it was",
                   id, steps->failed(), flow->steps_counted());
  if (steps->failed() > 0 && !steps->adaptive())
    error->warning(
        FLERR,
        "Fix rbc/ib {} took steps again, {} times, because they had gone wrong; if these "
        "are many, a shorter timestep or adapt costs less",
        id, steps->failed());
  if (masses && masses->unconverged() > 0)
    error->warning(FLERR, "Fix rbc/ib {} reached its maxiter of {} in {} steps", id, most_solves,
                   masses->unconverged());
  if (markers->implicit().unconverged() > 0)
    error->warning(FLERR, "Fix rbc/ib {} reached its maxiter of {} in {} evaluations", id,
                   most_solves, markers->implicit().unconverged());
}

/* ---------------------------------------------------------------------- */

double FixRBCIB::memory_usage()
{
  return static_cast<double>(markers->bytes() + steps->bytes() + (masses ? masses->bytes() : 0) +
                             (gaps ? gaps->bytes() : 0) + tractions.bytes() + contrast.bytes() +
                             RowExchange::bytes());
}
