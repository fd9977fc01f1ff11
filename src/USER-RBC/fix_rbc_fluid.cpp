#include "fix_rbc_fluid.h"

#include "comm.h"
#include "coupling/rbc_fluid_client.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "grid3d.h"
#include "modify.h"
#include "output.h"
#include "support/rbc_out_of_memory.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixRBCFluid::FixRBCFluid(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), grid_output(lmp), restarts(lmp, fmt::format("Fix rbc/fluid {}", id)),
    stop(lmp)
{
  scalar_flag = vector_flag = 1;
  size_vector = 22;
  global_freq = 1;
  extscalar = 1;
  extvector = 0;
  pergrid_flag = 1;
  pergrid_freq = 1;

  check_box();
  const std::string style = fmt::format("Fix rbc/fluid {}", id);
  FlowForcing forcing(lmp, style);
  const FluidSettings settings = read_fluid_settings(lmp, narg, arg, forcing);
  flow = std::make_unique<DrivenFlow>(lmp, style, settings, forcing);
  restart_global = flow->has_inertia();
  std::copy_n(domain->boxlo, 3, box_lo);
  std::copy_n(domain->boxhi, 3, box_hi);
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::check_box() const
{
  if (domain->box_exist == 0)
    error->all(FLERR, "Fix rbc/fluid must be used after the simulation box is defined");
  if (domain->dimension != 3) error->all(FLERR, "Fix rbc/fluid requires a 3d simulation");
  if (domain->triclinic) error->all(FLERR, "Fix rbc/fluid requires an orthogonal simulation box");
  if (!domain->xperiodic || !domain->yperiodic)
    error->all(FLERR,
               "Fix rbc/fluid requires periodic boundaries in x and y (boundary p p p, or p p f "
               "between plates); a vessel whose ends are ports lies as a whole, closed by walls of "
               "atoms, within such a box, 4 dx from its sides");
  if (!domain->zperiodic && (domain->boundary[2][0] != 1 || domain->boundary[2][1] != 1))
    error->all(FLERR,
               "Fix rbc/fluid requires z to be periodic or fixed (boundary p p p, or p p f between "
               "plates)");
}

/* ---------------------------------------------------------------------- */

int FixRBCFluid::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | POST_RUN;
}

/* ---------------------------------------------------------------------- */

int FixRBCFluid::modify_param(int narg, char **arg)
{
  if (strcmp(arg[0], "warn") != 0) return 0;
  if (narg < 2) utils::missing_cmd_args(FLERR, "fix_modify warn", error);
  flow->scene().choose_warnings(utils::logical(FLERR, arg[1], false, lmp));
  return 2;
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::init()
{
  if (modify->get_fix_by_style("^rbc/fluid$").size() > 1)
    error->all(FLERR, "Only one fix rbc/fluid may be defined");
  check_unchanged();
  if (domain->box_change_size || domain->box_change_shape)
    error->all(FLERR, "Fix rbc/fluid cannot be used with a changing simulation box");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/fluid cannot be used with run_style respa");
  if (!(update->dt > 0) && !(update->dt == 0 && update->nsteps == 0))
    error->all(FLERR, "Fix rbc/fluid {}: timestep {} must be > 0 (or 0, for run 0)", id,
               update->dt);
  if (flow->has_inertia() && output->restart_flag) restarts.check_size(flow->flow());
  check_drivers();
  if (comm->nprocs > 1 && !modify->get_fix_by_style("^balance$").empty()) check_averages();
  grid_output.free();
  flow->start_run(fluid_clients(modify), id);
  restart_global = flow->has_inertia() || flow->controls_flow_rate() || flow->walls();
}

/* ----------------------------------------------------------------------
   the grid stays as it was chosen when the fix was defined
------------------------------------------------------------------------- */

void FixRBCFluid::check_unchanged() const
{
  check_box();
  if (domain->zperiodic == flow->settings().plates)
    error->all(FLERR,
               "Fix rbc/fluid {}: z was {} when the fix was defined and is {} now; define the fix "
               "after change_box",
               id, domain->zperiodic ? "fixed" : "periodic",
               domain->zperiodic ? "periodic" : "fixed");
  for (int d = 0; d < 3; ++d)
    if (domain->boxlo[d] != box_lo[d] || domain->boxhi[d] != box_hi[d])
      error->all(FLERR,
                 "Fix rbc/fluid {}: the simulation box has changed since the fix was defined", id);
}

/* ----------------------------------------------------------------------
   fix ave/grid ends in a segmentation fault when its grid moves
------------------------------------------------------------------------- */

void FixRBCFluid::check_averages() const
{
  const auto &cells = flow->settings().cells;
  for (Fix *fix : modify->get_fix_by_style("^ave/grid$")) {
    int n[3];
    static_cast<Grid3d *>(fix->get_grid_by_index(0))->get_size(n[0], n[1], n[2]);
    if (std::equal(n, n + 3, cells.begin()))
      error->all(FLERR,
                 "Fix rbc/fluid {}: its grid cannot be averaged by fix ave/grid {} while load "
                 "balancing moves it: remove fix balance, or balance before fix ave/grid is "
                 "defined",
                 id, fix->id);
  }
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::check_drivers() const
{
  std::string driver;
  for (Fix *fix : modify->get_fix_list()) {
    const auto *const client = dynamic_cast<FluidClient *>(fix);
    if (!client || !client->drives_flow() || client->fluid_id() != id) continue;
    if (!driver.empty())
      error->all(FLERR,
                 "Fix rbc/fluid {} cannot be used by both fix rbc/ib {} and {}: use one fix rbc/ib "
                 "with a group that holds the atoms of both",
                 id, driver, fix->id);
    driver = fix->id;
    const auto &cells = flow->settings().cells;
    const double half = 0.5 * *std::min_element(cells.begin(), cells.end());
    if (client->cells_per_step() > half)
      error->all(FLERR,
                 "Fix rbc/ib {} courant value {} must be <= {}, half the cells of fix rbc/fluid {} "
                 "along the side with the fewest",
                 driver, client->cells_per_step(), half, id);
  }
}

/* ----------------------------------------------------------------------
   a client that drives the flow does all of this itself
------------------------------------------------------------------------- */

void FixRBCFluid::setup(int /*vflag*/)
{
  if (flow->is_driven()) return;
  flow->set_time_at_setup();
  do_or_run_out(lmp, fmt::format("Fix rbc/fluid {}", id), [this] {
    flow->hold_walls();
    if (!flow->has_inertia()) advance_alone();
    bool as_before = flow->walls() && flow->walls()->last_solves() == 1;
    for (; flow->probe_flow_rate(); as_before = false) advance_alone();
    flow->release_walls(as_before);
  });
  flow->count_from_here();
}

void FixRBCFluid::initial_integrate(int /*vflag*/)
{
  if (flow->is_driven() || !flow->walls()) return;
  flow->walls()->begin_step(false);
  flow->walls()->place(1);
}

void FixRBCFluid::final_integrate()
{
  if (flow->is_driven()) return;
  if (flow->has_inertia()) {
    flow->begin_step(false);
    flow->set_time(0.5);
  } else if (!flow->varies())
    return;
  else
    flow->correct_flow_rate();
  advance_alone();
}

void FixRBCFluid::advance_alone()
{
  if (flow->flow().has_force()) flow->clear_force();
  flow->solve(stop);
  flow->finish_step();
}

/* ----------------------------------------------------------------------
   load balancing moved the subdomains
------------------------------------------------------------------------- */

void FixRBCFluid::reset_grid()
{
  const std::vector<fluid::Box> before = flow->flow().decomposition().bricks;
  grid_output.free();
  flow->build();
  if (flow->flow().decomposition().bricks != before) check_averages();
}

/* ----------------------------------------------------------------------
   kinetic energy of the fluid
------------------------------------------------------------------------- */

double FixRBCFluid::compute_scalar()
{
  return flow->diagnostics().kinetic_energy_per_density * flow->settings().equations.density *
         force->mvv2e;
}

/* ----------------------------------------------------------------------
   1-3 traction on the lower plate, 4-6 on the upper; 7-9 mean velocity, 10 largest speed,
   11 divergence, 12 solves; then inside_value()
------------------------------------------------------------------------- */

double FixRBCFluid::compute_vector(int n)
{
  if (n == 11) return static_cast<double>(flow->solves());
  if (n > 11) return inside_value(n - 12);
  const fluid::FlowDiagnostics &now = flow->diagnostics();
  const double to_pressure = 1.0 / force->ftm2v;
  if (n < 3) return now.lower_traction[n] * to_pressure;
  if (n < 6) return now.upper_traction[n - 3] * to_pressure;
  if (n < 9) return now.mean_velocity[n - 6];
  return n == 9 ? now.max_speed : now.max_divergence;
}

/* ----------------------------------------------------------------------
   of the region inside, or of the whole box: mean velocity, flow rates through sections, uniform
   force density, volume
------------------------------------------------------------------------- */

double FixRBCFluid::inside_value(int n)
{
  if (n < 3) return flow->mean_inside()[n];
  if (n < 6) return flow->mean_inside()[n - 3] * flow->inside_volume() / domain->prd[n - 3];
  return n < 9 ? flow->driving_force(n - 6) : flow->inside_volume();
}

/* ---------------------------------------------------------------------- */

int FixRBCFluid::get_grid_by_name(const std::string &name, int &dim)
{
  if (name != "grid") return -1;
  dim = 3;
  return 0;
}

void *FixRBCFluid::get_grid_by_index(int index)
{
  return index == 0 ? flow->grid() : nullptr;
}

int FixRBCFluid::get_griddata_by_name(int igrid, const std::string &name, int &ncol)
{
  return igrid == 0 ? GridOutput::find(name, ncol) : -1;
}

void *FixRBCFluid::get_griddata_by_index(int index)
{
  flow->finish_evaluation();
  return grid_output.get(index, flow->flow(), flow->uniform_force(), flow->version());
}

/* ---------------------------------------------------------------------- */

double FixRBCFluid::memory_usage()
{
  return static_cast<double>(flow->flow().bytes()) + grid_output.bytes();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::write_restart(FILE *fp)
{
  if (flow->has_inertia())
    restarts.write(fp, flow->flow(), flow->solves());
  else
    restarts.write_memory(fp, flow->memory(FlowRestart::MOST_REMEMBERED));
}

void FixRBCFluid::restart(char *buffer)
{
  if (FlowRestart::is_of_steady_flow(buffer)) {
    if (!flow->has_inertia()) flow->remember(restarts.read_memory(buffer));
    return;
  }
  flow->set_earlier_solves(restarts.restore(buffer, flow->flow()));
  flow->changed();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::post_run()
{
  if (flow->walls() && comm->me == 0) flow->walls()->warn();
  if (flow->is_driven()) return;
  const std::string text = fmt::format(
      "\nUSER-RBC step cost: {} solves in {} steps, no vertices, {} fluid cells, {} MPI "
      "task{}\n{}",
      flow->solves_counted(), flow->steps_counted(), flow->flow().grid().size(), comm->nprocs,
      comm->nprocs > 1 ? "s" : "", flow->costs());
  if (comm->me == 0) utils::logmesg(lmp, text);
}
