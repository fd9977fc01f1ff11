#include "fix_rbc_fluid.h"

#include "fix_rbc_ib.h"
#include "fix_rbc_wall.h"
#include "rbc_rigid_walls.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "grid3d.h"
#include "math_const.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr double MAX_COURANT = 1.0;
static constexpr double PROBE_COURANT = 0.02;

// reach of the widest kernel beyond the cell of an atom, staggering included

static constexpr int KERNEL_LAYERS = 2;

/* ---------------------------------------------------------------------- */

FixRBCFluid::FixRBCFluid(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), drive(lmp, fmt::format("Fix rbc/fluid {}", id)), centred(lmp),
    restarts(lmp, fmt::format("Fix rbc/fluid {}", id)), stop(lmp)
{
  scalar_flag = vector_flag = 1;
  size_vector = 22;
  global_freq = 1;
  extscalar = 1;
  extvector = 0;
  pergrid_flag = 1;
  pergrid_freq = 1;

  if (domain->box_exist == 0)
    error->all(FLERR, "Fix rbc/fluid must be used after the simulation box is defined");
  if (domain->dimension != 3) error->all(FLERR, "Fix rbc/fluid requires a 3d simulation");
  if (domain->triclinic) error->all(FLERR, "Fix rbc/fluid requires an orthogonal simulation box");
  if (!domain->xperiodic || !domain->yperiodic)
    error->all(FLERR, "Fix rbc/fluid requires periodic boundaries in x and y");
  if (!domain->zperiodic && (domain->boundary[2][0] != 1 || domain->boundary[2][1] != 1))
    error->all(FLERR, "Fix rbc/fluid requires z to be periodic or fixed (boundary p or f)");

  settings = read_fluid_settings(lmp, narg, arg, drive);
  inside = std::make_unique<FlowInside>(lmp, fmt::format("fix rbc/fluid {}", id), settings.inside);
  restart_global = has_inertia();
  std::copy_n(domain->boxlo, 3, box_lo);
  std::copy_n(domain->boxhi, 3, box_hi);
  build_flow();
}

/* ---------------------------------------------------------------------- */

FixRBCFluid::~FixRBCFluid() = default;

/* ----------------------------------------------------------------------
   without vertices none; a vertex leaves its subdomain by half the skin before atoms migrate and by half a cell more
   within a step, and cells belong to the subdomain of their centres
------------------------------------------------------------------------- */

int FixRBCFluid::layers_needed() const
{
  if (!driven && !rigid) return 0;
  const auto &cells = settings.cells;
  double layers = 0;
  for (int d = 0; d < 3; ++d)
    layers = std::max(layers, 0.5 * neighbor->skin / (domain->prd[d] / cells[d]) + cells_per_step);
  return static_cast<int>(std::ceil(layers)) + KERNEL_LAYERS + (sheets ? 1 : 0);
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::build_flow()
{
  centred.free();
  inside->forget();
  const auto &cells = settings.cells;
  grid = std::make_unique<Grid3d>(lmp, world, cells[0], cells[1], cells[2]);
  int lo[3], hi[3], outlo[3], outhi[3];
  grid->setup_grid(lo[0], hi[0], lo[1], hi[1], lo[2], hi[2], outlo[0], outhi[0], outlo[1], outhi[1],
                   outlo[2], outhi[2]);

  fluid::Grid staggered;
  fluid::Box brick;
  for (int d = 0; d < 3; ++d) {
    brick.lo[d] = lo[d];
    brick.hi[d] = hi[d] + 1;
    staggered.cells[d] = cells[d];
    staggered.origin[d] = domain->boxlo[d];
    staggered.spacing[d] = domain->prd[d] / cells[d];
  }
  staggered.walls = settings.plates;

  ghost_layers = layers_needed();
  auto flow = std::make_unique<fluid::Flow>(staggered, fluid::Decomposition(world, brick),
                                            ghost_layers, settings.regime);
  if (current_flow) {
    earlier_traffic = traffic();
    flow->take_over(*current_flow);
  }
  current_flow = std::move(flow);
  flow_changed();
}

/* ---------------------------------------------------------------------- */

int FixRBCFluid::setmask()
{
  return FINAL_INTEGRATE | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::init()
{
  if (modify->get_fix_by_style("^rbc/fluid$").size() > 1)
    error->all(FLERR, "Only one fix rbc/fluid may be defined");
  if (domain->box_change_size || domain->box_change_shape)
    error->all(FLERR, "Fix rbc/fluid cannot be used with a changing simulation box");
  for (int d = 0; d < 3; ++d)
    if (domain->boxlo[d] != box_lo[d] || domain->boxhi[d] != box_hi[d])
      error->all(FLERR,
                 "Fix rbc/fluid {}: the simulation box has changed since the fix was defined", id);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/fluid cannot be used with run_style respa");
  drive.check();
  inside->forget();    // the region may be another one
  if (has_inertia() && output->restart_flag) restarts.check_size(*current_flow);

  std::string driver;
  sheets = false;
  for (Fix *fix : modify->get_fix_by_style("^rbc/ib$")) {
    const auto ib = dynamic_cast<FixRBCIB *>(fix);
    if (ib->fluid() != id) continue;
    if (!driver.empty())
      error->all(FLERR, "Fix rbc/fluid {} cannot be used by both fix rbc/ib {} and {}", id, driver,
                 fix->id);
    driver = fix->id;
    cells_per_step = ib->courant();
    sheets = ib->has_sheets();
    const double half = 0.5 * *std::min_element(settings.cells.begin(), settings.cells.end());
    if (cells_per_step > half)
      error->all(FLERR,
                 "Fix rbc/ib {} courant value {} must be <= {}, half the cells of fix rbc/fluid {} "
                 "along the side with the fewest",
                 driver, cells_per_step, half, id);
  }
  driven = !driver.empty();
  find_walls();
  if (layers_needed() != ghost_layers) build_flow();
  start_control();
}

/* ----------------------------------------------------------------------
   probes with Poiseuille flow in a round tube as wide as the inside is in the mean, slow enough for atoms in throats
------------------------------------------------------------------------- */

void FixRBCFluid::start_control()
{
  if (drive.held_direction() < 0) return;
  const double section = inside->volume(*current_flow) / domain->prd[drive.held_direction()];
  const double velocity = PROBE_COURANT * smallest_spacing() / update->dt;
  const bool by_mean = holds_box_mean();
  drive.start_control(by_mean, by_mean ? velocity
                                       : 8 * MathConst::MY_PI * settings.regime.viscosity *
                                             velocity / section);
}

/* ----------------------------------------------------------------------
   with walls the mean velocity of a triply periodic box follows from the balance of forces unless it is given
------------------------------------------------------------------------- */

void FixRBCFluid::find_walls()
{
  balanced = !settings.plates && !has_inertia() && !settings.prescribed_mean;
  if (!rigid) rigid = std::make_unique<RigidWalls>(lmp);
  if (!rigid->connect(id, balanced)) {
    rigid.reset();
    balanced = false;
  }
  if (rigid && has_inertia())
    error->all(FLERR, "{} needs fix rbc/fluid {} inertia none", rigid->first()->style_name(), id);
  if (rigid) return;
  if (!has_inertia() && settings.free_mean)
    error->all(FLERR, "Fix rbc/fluid mean force needs inertia unsteady or convective, or a fix "
                      "rbc/wall: without them a net force has nothing to accelerate or to act on");
  if (!holds_box_mean() || comm->me != 0) return;
  if (drive.held_direction() >= 0) {
    if (!settings.inside.empty())
      error->warning(FLERR,
                     "Fix rbc/fluid {} inside {}: there is no fix rbc/wall to keep the flow "
                     "inside, that of the whole box is held",
                     id, settings.inside);
    return;
  }
  for (const NumberOrVariable &component : drive.body)
    if (component.is_variable() || component.value(lmp) != 0) {
      error->warning(FLERR, "Fix rbc/fluid body has no effect in a triply periodic box whose "
                            "mean velocity is held: a pressure gradient balances it");
      break;
    }
}

/* ----------------------------------------------------------------------
   the body force acts inside only: beside walls that are sheared on both sides they would seem further off
------------------------------------------------------------------------- */

void FixRBCFluid::spread_walls(const std::array<double, 3> &others, CollectiveStop &report)
{
  if (!rigid) return;
  current_flow->drive = forcing;
  std::array<double, 3> sum = others;
  const fluid::Vec3 &body = forcing.body;
  const double volume = inside->volume(*current_flow);
  if (comm->me == 0)
    for (int d = 0; d < 3; ++d) sum[d] += body[d] * volume;
  if (auto *const interior = inside->find(*current_flow)) {
    interior->add_force(*current_flow, body);
    current_flow->drive.body = {0, 0, 0};
  }
  const double end = update->atime + (update->ntimestep - update->atimestep) * update->dt;
  rigid->spread(*current_flow, end - (1 - fraction) * update->dt, sum, report);
}

void FixRBCFluid::enforce_walls()
{
  if (rigid) rigid->enforce(*current_flow);
}

void FixRBCFluid::place_walls(double at)
{
  fraction = at;
  if (rigid) rigid->place(at);
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::setup(int /*vflag*/)
{
  if (driven) return;
  drive_at_setup();
  if (!has_inertia()) advance_alone();
  for (bool again = holds_inside(); again;) {
    again = correct_drive();
    advance_alone();
  }
  count_from_here();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::final_integrate()
{
  if (driven) return;
  if (has_inertia()) {
    begin_step();
    drive_at(0.5);
    current_flow->start_step(update->dt);
    drive_end();
    current_flow->finish_step();
    flow_changed();
  } else if (drive.varies() || (rigid && rigid->moves())) {
    if (holds_inside())
      correct_drive();
    else
      drive_now();
    advance_alone();
  }
}

/* ----------------------------------------------------------------------
   steady flow without other immersed boundaries than walls
------------------------------------------------------------------------- */

void FixRBCFluid::advance_alone()
{
  if (rigid) {
    current_flow->clear_force();
    spread_walls({0, 0, 0}, stop);
    stop.check();
    current_flow->gather_force();
  }
  current_flow->solve();
  enforce_walls();
  flow_changed();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::flow_changed()
{
  ++version;
  if (settings.regime.inertia == fluid::Inertia::convective) check_courant();
}

/* ----------------------------------------------------------------------
   explicit advection: the fluid may not cross more than a cell in a step
------------------------------------------------------------------------- */

void FixRBCFluid::check_courant()
{
  const auto fastest =
      fluid::fastest_cell(current_flow->grid(), current_flow->brick(), current_flow->velocity());
  const double courant = fastest.rate * update->dt;
  if (!(courant <= MAX_COURANT)) {
    std::array<double, 3> x;
    for (int d = 0; d < 3; ++d)
      x[d] = domain->boxlo[d] + (fastest.cell[d] + 0.5) * current_flow->grid().spacing[d];
    report_too_fast(x, courant);
  }
  stop.check();
}

void FixRBCFluid::report_too_fast(const std::array<double, 3> &x, double courant)
{
  const std::string place = fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
  if (std::isfinite(courant))
    stop.report(fmt::format("Fix rbc/fluid {}: the fluid at {} crosses {:.3g} cells in a step at "
                            "step {} (CFL above {}; timestep too large for inertia convective)",
                            id, place, courant, update->ntimestep, MAX_COURANT));
  else
    stop.report(
        fmt::format("Fix rbc/fluid {}: the velocity of the fluid at {} is not a number at step {}",
                    id, place, update->ntimestep));
}

/* ----------------------------------------------------------------------
   a flow that has made steps goes on from the drive at the end of the last, though variables may jump between runs
------------------------------------------------------------------------- */

void FixRBCFluid::drive_at_setup()
{
  ++version;
  if (has_inertia() && drive.is_known())
    drive_end();
  else
    drive_now();
}

void FixRBCFluid::drive_now()
{
  fraction = 1;
  set_forcing(drive.evaluate());
}

void FixRBCFluid::set_forcing(const fluid::Drive &by)
{
  forcing = current_flow->drive = by;
}

/* ----------------------------------------------------------------------
   by what the last solve gave inside the vessel; true if the next one is a probe
------------------------------------------------------------------------- */

bool FixRBCFluid::correct_drive()
{
  drive.measured(mean_inside()[drive.held_direction()]);
  drive_now();
  return drive.probing();
}

void FixRBCFluid::begin_step(bool again)
{
  if (holds_inside() && !again) drive.measured(mean_inside()[drive.held_direction()]);
  drive.begin_step(again);
  if (rigid) rigid->begin_step(again);
}

void FixRBCFluid::drive_at(double at)
{
  place_walls(at);
  set_forcing(drive.at(at));
}

void FixRBCFluid::drive_end()
{
  set_forcing(drive.end());
}

/* ---------------------------------------------------------------------- */

double FixRBCFluid::smallest_spacing() const
{
  const auto &h = current_flow->grid().spacing;
  return std::min({h[0], h[1], h[2]});
}

/* ----------------------------------------------------------------------
   load balancing moved the subdomains
------------------------------------------------------------------------- */

void FixRBCFluid::reset_grid()
{
  build_flow();
}

/* ---------------------------------------------------------------------- */

const fluid::FlowMeasures &FixRBCFluid::measure()
{
  if (measured_version != version) {
    measures = fluid::measure(*current_flow);
    measured_version = version;
  }
  return measures;
}

/* ----------------------------------------------------------------------
   kinetic energy of the fluid
------------------------------------------------------------------------- */

double FixRBCFluid::compute_scalar()
{
  return measure().kinetic_energy_per_density * settings.regime.density * force->mvv2e;
}

/* ---------------------------------------------------------------------- */

double FixRBCFluid::compute_vector(int n)
{
  if (n == 11) return static_cast<double>(solves());
  if (n > 11) return inside_value(n - 12);
  const fluid::FlowMeasures &m = measure();
  const double to_pressure = 1.0 / force->ftm2v;
  if (n < 3) return m.lower_traction[n] * to_pressure;
  if (n < 6) return m.upper_traction[n - 3] * to_pressure;
  if (n < 9) return m.mean_velocity[n - 6];
  return n == 9 ? m.max_speed : m.max_divergence;
}

/* ----------------------------------------------------------------------
   of the region inside, or of the whole box: mean velocity, flow rates through sections, uniform force density, volume
------------------------------------------------------------------------- */

const fluid::Vec3 &FixRBCFluid::mean_inside()
{
  return settings.inside.empty() ? measure().mean_velocity
                                 : inside->mean_velocity(*current_flow, version);
}

double FixRBCFluid::inside_value(int n)
{
  if (n < 3) return mean_inside()[n];
  if (n < 6) return mean_inside()[n - 3] * inside->volume(*current_flow) / domain->prd[n - 3];
  return n < 9 ? driving_force(n - 6) : inside->volume(*current_flow);
}

/* ----------------------------------------------------------------------
   body force, or the pressure gradient that balances all forces where the mean velocity is held
------------------------------------------------------------------------- */

double FixRBCFluid::driving_force(int d) const
{
  double density = drive.end().body[d];
  if (holds_box_mean() && !has_inertia()) density = -current_flow->mean_force()[d];
  return density / force->ftm2v;
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
  return index == 0 ? grid.get() : nullptr;
}

int FixRBCFluid::get_griddata_by_name(int igrid, const std::string &name, int &ncol)
{
  return igrid == 0 ? CentredData::find(name, ncol) : -1;
}

void *FixRBCFluid::get_griddata_by_index(int index)
{
  return centred.get(index, *current_flow, version);
}

/* ---------------------------------------------------------------------- */

double FixRBCFluid::memory_usage()
{
  return static_cast<double>(current_flow->bytes()) + centred.bytes();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::write_restart(FILE *fp)
{
  restarts.write(fp, *current_flow, solves());
}

void FixRBCFluid::restart(char *buffer)
{
  earlier_solves = restarts.restore(buffer, *current_flow);
  flow_changed();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::count_from_here()
{
  first_traffic = traffic();
  first_solve = solves();
  first_step = update->ntimestep;
  if (rigid) rigid->reset_counts();
}

fluid::Traffic FixRBCFluid::traffic() const
{
  const fluid::Traffic now = current_flow->traffic();
  return {earlier_traffic.messages + now.messages, earlier_traffic.bytes + now.bytes};
}

/* ----------------------------------------------------------------------
   what the flow took since count_from_here; collective
------------------------------------------------------------------------- */

std::string FixRBCFluid::costs(bigint steps) const
{
  const fluid::Traffic now = traffic();
  double sums[3] = {double(now.messages - first_traffic.messages),
                    double(now.bytes - first_traffic.bytes), double(current_flow->bytes())};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
  const double each = 1.0 / (double(steps > 0 ? steps : 1) * comm->nprocs);
  return fmt::format(
      "Fluid: {:.4g} messages and {:.4g} bytes per step and MPI task, {:.4g} bytes of "
      "memory per cell\n",
      sums[0] * each, sums[1] * each, sums[2] / current_flow->grid().size());
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::post_run()
{
  if (rigid && comm->me == 0) rigid->warn();
  if (driven) return;
  const bigint steps = update->ntimestep - first_step;
  const std::string text = fmt::format(
      "\nUSER-RBC step cost: {} solves in {} steps, no vertices, {} fluid cells, {} MPI "
      "task{}\n{}",
      solves() - first_solve, steps, current_flow->grid().size(), comm->nprocs,
      comm->nprocs > 1 ? "s" : "", costs(steps));
  if (comm->me == 0) utils::logmesg(lmp, text);
}
