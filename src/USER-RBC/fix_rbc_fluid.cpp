#include "fix_rbc_fluid.h"

#include "fix_rbc_ib.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "grid3d.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr int MIN_CELLS = 4;
static constexpr double MAX_CELLS =
    0.25 * MAXSMALLINT;    // on a rank: a message counts three values of each in an int
static constexpr int KERNEL_LAYERS =
    3;    // reach of the widest kernel beyond a subdomain, staggering included

/* ---------------------------------------------------------------------- */

FixRBCFluid::FixRBCFluid(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  scalar_flag = vector_flag = 1;
  size_vector = 12;
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

  parse(narg, arg);
  std::copy_n(domain->boxlo, 3, box_lo);
  std::copy_n(domain->boxhi, 3, box_hi);
  choose_grid();
  check_grid();
  build_flow();
}

/* ---------------------------------------------------------------------- */

FixRBCFluid::~FixRBCFluid()
{
  free_data();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::parse_vector(int iarg, int narg, char **arg, const char *keyword,
                               std::array<NumberOrVariable, 3> &vector)
{
  if (iarg + 3 > narg)
    utils::missing_cmd_args(FLERR, std::string("fix rbc/fluid ") + keyword, error);
  for (int d = 0; d < 3; ++d) vector[d] = NumberOrVariable(lmp, arg[iarg + d]);
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::parse(int narg, char **arg)
{
  bool wall_given[2] = {false, false};
  int iarg = 3;
  const auto need = [&](int n, const char *keyword) {
    if (iarg + n >= narg)
      utils::missing_cmd_args(FLERR, std::string("fix rbc/fluid ") + keyword, error);
  };
  const auto positive = [&](int at, const char *keyword) {
    const double value = utils::numeric(FLERR, arg[at], false, lmp);
    if (!(value > 0))
      error->all(FLERR, at, "Fix rbc/fluid {} value {} must be > 0", keyword, arg[at]);
    return value;
  };

  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    if (keyword == "dx") {
      need(1, "dx");
      target_spacing = positive(iarg + 1, "dx");
      iarg += 2;
    } else if (keyword == "grid") {
      need(3, "grid");
      for (int d = 0; d < 3; ++d) {
        cells[d] = utils::inumeric(FLERR, arg[iarg + 1 + d], false, lmp);
        if (cells[d] < MIN_CELLS)
          error->all(FLERR, iarg + 1 + d,
                     "Fix rbc/fluid grid value {} must be at least {} cells in every direction",
                     arg[iarg + 1 + d], MIN_CELLS);
      }
      iarg += 4;
    } else if (keyword == "viscosity") {
      need(1, "viscosity");
      viscosity = positive(iarg + 1, "viscosity");
      iarg += 2;
    } else if (keyword == "density") {
      need(1, "density");
      density = positive(iarg + 1, "density");
      iarg += 2;
    } else if (keyword == "inertia") {
      need(1, "inertia");
      if (strcmp(arg[iarg + 1], "none") != 0)
        error->all(FLERR, iarg + 1,
                   "Fix rbc/fluid inertia value {} is not available; allowed: none", arg[iarg + 1]);
      iarg += 2;
    } else if (keyword == "scheme") {
      need(1, "scheme");
      if (strcmp(arg[iarg + 1], "coupled") != 0)
        error->all(FLERR, iarg + 1,
                   "Fix rbc/fluid scheme value {} is not available; allowed: coupled",
                   arg[iarg + 1]);
      iarg += 2;
    } else if (keyword == "wall") {
      need(1, "wall");
      const std::string side = arg[iarg + 1];
      if (side != "zlo" && side != "zhi")
        error->all(FLERR, iarg + 1, "Fix rbc/fluid wall side {} must be zlo or zhi", side);
      if (domain->zperiodic)
        error->all(FLERR, iarg,
                   "Fix rbc/fluid wall {} on a periodic side: z must be fixed (boundary p p f)",
                   side);
      parse_vector(iarg + 2, narg, arg, "wall", side == "zlo" ? lower : upper);
      const NumberOrVariable &normal = (side == "zlo" ? lower : upper)[2];
      if (normal.is_variable() || normal.value(lmp) != 0)
        error->all(
            FLERR, iarg + 4,
            "Fix rbc/fluid wall {} velocity {} along z must be 0: plates move along themselves",
            side, arg[iarg + 4]);
      wall_given[side == "zhi"] = true;
      iarg += 5;
    } else if (keyword == "body") {
      parse_vector(iarg + 1, narg, arg, "body", body);
      iarg += 4;
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/fluid keyword {}; allowed: dx, grid, viscosity, density, "
                 "inertia, scheme, wall, body",
                 keyword);
  }

  for (const auto *vector : {&lower, &upper, &body})
    for (const NumberOrVariable &component : *vector) varying = varying || component.is_variable();
  walls = !domain->zperiodic;
  if (walls && !(wall_given[0] && wall_given[1]))
    error->all(FLERR, "Fix rbc/fluid needs wall zlo and wall zhi where z is not periodic");
  if (!walls && comm->me == 0)
    for (const NumberOrVariable &component : body)
      if (component.is_variable() || component.value(lmp) != 0) {
        error->warning(FLERR, "Fix rbc/fluid body has no effect in a triply periodic box: a "
                              "pressure gradient balances it");
        break;
      }
  if (target_spacing == 0 && cells[0] == 0) error->all(FLERR, "Fix rbc/fluid needs dx or grid");
  if (target_spacing > 0 && cells[0] > 0)
    error->all(FLERR, "Fix rbc/fluid takes either dx or grid, not both");
  if (viscosity == 0) error->all(FLERR, "Fix rbc/fluid needs viscosity");
  if (density == 0) error->all(FLERR, "Fix rbc/fluid needs density");
}

/* ----------------------------------------------------------------------
   spacing as near to dx as a whole number of cells allows
------------------------------------------------------------------------- */

void FixRBCFluid::choose_grid()
{
  if (target_spacing == 0) return;
  for (int d = 0; d < 3; ++d) {
    const double wanted = std::round(domain->prd[d] / target_spacing);
    const double largest = domain->prd[d] / MIN_CELLS;
    if (wanted < MIN_CELLS)
      error->all(
          FLERR,
          "Fix rbc/fluid dx {} leaves {} cells in {}; at least {} are needed (dx at most {})",
          target_spacing, wanted, "xyz"[d], MIN_CELLS, largest);
    cells[d] = static_cast<int>(std::min<double>(wanted, MAXSMALLINT));
  }
}

/* ----------------------------------------------------------------------
   LAMMPS counts the cells of a rank in an int
------------------------------------------------------------------------- */

void FixRBCFluid::check_grid() const
{
  const double each = double(cells[0]) * cells[1] * cells[2] / comm->nprocs;
  if (each > MAX_CELLS)
    error->all(
        FLERR,
        "Fix rbc/fluid {} {} asks for {:.3g} cells per MPI task; at most {:.3g} are possible",
        target_spacing > 0 ? "dx" : "grid",
        target_spacing > 0 ? fmt::format("{}", target_spacing)
                           : fmt::format("{} {} {}", cells[0], cells[1], cells[2]),
        each, MAX_CELLS);
}

/* ----------------------------------------------------------------------
   a vertex leaves its subdomain by half the skin before atoms migrate, and within a step by half a cell more
------------------------------------------------------------------------- */

int FixRBCFluid::layers_needed() const
{
  double layers = 0;
  for (int d = 0; d < 3; ++d)
    layers = std::max(layers, 0.5 * neighbor->skin / (domain->prd[d] / cells[d]) + 0.5);
  return static_cast<int>(std::ceil(layers)) + KERNEL_LAYERS;
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::build_flow()
{
  fluid::Drive drive;
  if (stokes_flow) {
    measure();
    drive = stokes_flow->drive;
  }
  free_data();
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
  staggered.walls = walls;

  ghost_layers = layers_needed();
  stokes_flow = std::make_unique<fluid::Flow>(staggered, fluid::Decomposition(world, brick),
                                              ghost_layers, fluid::Regime{viscosity, density});
  stokes_flow->drive = drive;
  current = false;
}

/* ---------------------------------------------------------------------- */

int FixRBCFluid::setmask()
{
  return FINAL_INTEGRATE;
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
  for (const auto *vector : {&lower, &upper, &body})
    for (const auto &component : *vector) component.check(lmp, "fix rbc/fluid");

  std::string driver;
  for (Fix *fix : modify->get_fix_by_style("^rbc/ib$")) {
    if (dynamic_cast<FixRBCIB *>(fix)->fluid() != id) continue;
    if (!driver.empty())
      error->all(FLERR, "Fix rbc/fluid {} cannot be used by both fix rbc/ib {} and {}", id, driver,
                 fix->id);
    driver = fix->id;
  }
  driven = !driver.empty();
  if (layers_needed() != ghost_layers) build_flow();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::setup(int /*vflag*/)
{
  if (!driven) solve_alone();
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::final_integrate()
{
  if (!driven && (varying || !current)) solve_alone();
}

/* ----------------------------------------------------------------------
   flow without immersed boundaries: steady unless a variable drives it
------------------------------------------------------------------------- */

void FixRBCFluid::solve_alone()
{
  update_drive(false);
  stokes_flow->clear_force();
  stokes_flow->solve();
  stokes_flow->share_velocity();
  solved();
}

/* ----------------------------------------------------------------------
   variables know the end of a step only: in its middle they count as the mean of its ends
------------------------------------------------------------------------- */

void FixRBCFluid::update_drive(bool middle)
{
  if (!varying && drive_known) return;
  drive_known = true;
  modify->clearstep_compute();
  fluid::Drive now;
  for (int d = 0; d < 3; ++d) {
    now.walls.lower[d] = lower[d].value(lmp);
    now.walls.upper[d] = upper[d].value(lmp);
    now.body[d] = body[d].value(lmp) * force->ftm2v;
  }
  modify->addstep_compute(update->ntimestep + 1);

  for (const auto *vector : {&now.walls.lower, &now.walls.upper, &now.body})
    for (double component : *vector)
      if (!std::isfinite(component))
        error->all(FLERR,
                   "Fix rbc/fluid {}: a plate velocity or body force is not a number at step {}",
                   id, update->ntimestep);

  fluid::Drive &drive = stokes_flow->drive;
  if (middle)
    for (int d = 0; d < 3; ++d) {
      now.walls.lower[d] = 0.5 * (now.walls.lower[d] + drive.walls.lower[d]);
      now.walls.upper[d] = 0.5 * (now.walls.upper[d] + drive.walls.upper[d]);
      now.body[d] = 0.5 * (now.body[d] + drive.body[d]);
    }
  drive = now;
}

/* ---------------------------------------------------------------------- */

double FixRBCFluid::smallest_spacing() const
{
  const auto &h = stokes_flow->grid().spacing;
  return std::min({h[0], h[1], h[2]});
}

/* ----------------------------------------------------------------------
   load balancing moved the subdomains; steady flow has no history to carry over and is solved anew in this step
------------------------------------------------------------------------- */

void FixRBCFluid::reset_grid()
{
  build_flow();
}

/* ---------------------------------------------------------------------- */

const fluid::FlowMeasures &FixRBCFluid::measure()
{
  if (measured_solves != nsolves) {
    measures = fluid::measure(*stokes_flow);
    measured_solves = nsolves;
  }
  return measures;
}

/* ----------------------------------------------------------------------
   kinetic energy of the fluid
------------------------------------------------------------------------- */

double FixRBCFluid::compute_scalar()
{
  return measure().kinetic_energy_per_density * density * force->mvv2e;
}

/* ---------------------------------------------------------------------- */

double FixRBCFluid::compute_vector(int n)
{
  if (n == 11) return static_cast<double>(nsolves);
  const fluid::FlowMeasures &m = measure();
  const double to_pressure = 1.0 / force->ftm2v;
  if (n < 3) return m.lower_traction[n] * to_pressure;
  if (n < 6) return m.upper_traction[n - 3] * to_pressure;
  if (n < 9) return m.mean_velocity[n - 6];
  return n == 9 ? m.max_speed : m.max_divergence;
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
  if (igrid != 0) return -1;
  ncol = name == "pressure" ? 0 : 3;
  if (name == "velocity") return VELOCITY;
  if (name == "pressure") return PRESSURE;
  if (name == "force") return FORCE;
  return -1;
}

/* ----------------------------------------------------------------------
   data is made when a dump or fix ave/grid asks for it, at most once per solve
   pressure costs a solve; all ranks ask in the same order
------------------------------------------------------------------------- */

void *FixRBCFluid::get_griddata_by_index(int index)
{
  if (index < 0 || index >= NDATA) return nullptr;
  const fluid::Box &box = stokes_flow->brick();
  const auto &[lo, hi] = box;
  if (!data[index]) {
    if (index == PRESSURE) {
      double ***p = nullptr;
      memory->create3d_offset(p, lo[2], hi[2] - 1, lo[1], hi[1] - 1, lo[0], hi[0] - 1,
                              "rbc/fluid:pressure");
      data[index] = p;
    } else {
      double ****v = nullptr;
      memory->create4d_offset_last(v, lo[2], hi[2] - 1, lo[1], hi[1] - 1, lo[0], hi[0] - 1, 3,
                                   "rbc/fluid:data");
      data[index] = v;
    }
    data_solves[index] = -1;
  }
  if (data_solves[index] == nsolves) return data[index];
  data_solves[index] = nsolves;

  if (index == PRESSURE) {
    const auto pressure = stokes_flow->pressure()[0];
    const double to_pressure = 1.0 / force->ftm2v;
    auto p = static_cast<double ***>(data[index]);
    for (int k = lo[2]; k < hi[2]; ++k)
      for (int j = lo[1]; j < hi[1]; ++j)
        for (int i = lo[0]; i < hi[0]; ++i) p[k][j][i] = pressure(i, j, k) * to_pressure;
  } else if (index == VELOCITY)
    fill_velocity_or_force(static_cast<double ****>(data[index]), stokes_flow->velocity(),
                           {0, 0, 0}, 1.0);
  else {
    stokes_flow->share_force();
    fill_velocity_or_force(static_cast<double ****>(data[index]), stokes_flow->force(),
                           stokes_flow->drive.body, 1.0 / force->ftm2v);
  }
  return data[index];
}

/* ----------------------------------------------------------------------
   faces to centres
------------------------------------------------------------------------- */

void FixRBCFluid::fill_velocity_or_force(double ****centred, const fluid::VectorField &field,
                                         const std::array<double, 3> &uniform, double scale)
{
  const auto &[lo, hi] = stokes_flow->brick();
  const auto u = field.views();
  for (int k = lo[2]; k < hi[2]; ++k)
    for (int j = lo[1]; j < hi[1]; ++j)
      for (int i = lo[0]; i < hi[0]; ++i) {
        centred[k][j][i][0] = scale * (0.5 * (u[0](i, j, k) + u[0](i + 1, j, k)) + uniform[0]);
        centred[k][j][i][1] = scale * (0.5 * (u[1](i, j, k) + u[1](i, j + 1, k)) + uniform[1]);
        centred[k][j][i][2] = scale * (0.5 * (u[2](i, j, k) + u[2](i, j, k + 1)) + uniform[2]);
      }
}

/* ---------------------------------------------------------------------- */

void FixRBCFluid::free_data()
{
  if (!stokes_flow) return;
  const auto &lo = stokes_flow->brick().lo;
  for (int index = 0; index < NDATA; ++index) {
    if (!data[index]) continue;
    if (index == PRESSURE) {
      auto p = static_cast<double ***>(data[index]);
      memory->destroy3d_offset(p, lo[2], lo[1], lo[0]);
    } else {
      auto v = static_cast<double ****>(data[index]);
      memory->destroy4d_offset_last(v, lo[2], lo[1], lo[0]);
    }
    data[index] = nullptr;
  }
}

/* ---------------------------------------------------------------------- */

double FixRBCFluid::memory_usage()
{
  double bytes = static_cast<double>(stokes_flow->bytes());
  const double cells_here = static_cast<double>(stokes_flow->brick().size());
  for (int index = 0; index < NDATA; ++index)
    if (data[index]) bytes += cells_here * (index == PRESSURE ? 1 : 3) * sizeof(double);
  return bytes;
}
