#include "fix_rbc_ib.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "fix_rbc_membrane.h"
#include "fix_store_atom.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

// integrator rkc auto: steps between estimates of the spectral radius, its safety factor, and how far points are
// displaced for it, over the spacing of the fluid

static constexpr int RADIUS_EVERY = 50;
static constexpr double RADIUS_SAFETY = 1.1;
static constexpr double RADIUS_DISPLACEMENT = 1.0e-5;

// integrator rkc of an order above 2: largest ratio of a timestep to the one before, parts of a step without a past

static constexpr double LARGEST_GROWTH = 1.2;
static constexpr int STARTING_PARTS = 16;

static constexpr int NSTATE = 3 + rbc::Path::LONGEST;    // numbers in restart files

/* ---------------------------------------------------------------------- */

FixRBCIB::FixRBCIB(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  time_integrate = 1;
  vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extvector = 0;

  if (narg < 4) utils::missing_cmd_args(FLERR, "fix rbc/ib", error);
  fluid_id = arg[3];
  parse(narg, arg);

  if (stored() > 0) create_attribute = 1;
  if (stored() > 0 || control.active()) restart_global = 1;
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::parse(int narg, char **arg)
{
  double courant = 1;
  int stages = 0, order = 2;
  int iarg = 4;
  const auto need = [&](int n, const std::string &keyword) {
    if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "fix rbc/ib " + keyword, error);
  };
  const auto positive = [&](int at, const std::string &name) {
    const double value = utils::numeric(FLERR, arg[at], false, lmp);
    if (!(value > 0)) error->all(FLERR, at, "Fix rbc/ib {} value {} must be > 0", name, arg[at]);
    return value;
  };
  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    need(1, keyword);
    const std::string value = arg[iarg + 1];
    if (keyword == "kernel") {
      if (value == "peskin4")
        kernel = fluid::KernelKind::peskin4;
      else if (value == "roma3")
        kernel = fluid::KernelKind::roma3;
      else
        error->all(FLERR, iarg + 1, "Unknown fix rbc/ib kernel {}; allowed: peskin4, roma3", value);
    } else if (keyword == "integrator") {
      if (value == "midpoint")
        integrator = Integrator::MIDPOINT;
      else if (value == "euler")
        integrator = Integrator::EULER;
      else if (value == "ab2")
        integrator = Integrator::AB2;
      else if (value == "rkc") {
        integrator = Integrator::RKC;
        need(2, "integrator rkc");
        automatic_stages = strcmp(arg[iarg + 2], "auto") == 0;
        if (!automatic_stages) {
          stages = utils::inumeric(FLERR, arg[iarg + 2], false, lmp);
          if (stages < rbc::ChebyshevMethod::LEAST_STAGES ||
              stages > rbc::ChebyshevMethod::MOST_STAGES)
            error->all(FLERR, iarg + 2, "Fix rbc/ib rkc stages {} must be auto or from {} to {}",
                       arg[iarg + 2], rbc::ChebyshevMethod::LEAST_STAGES,
                       rbc::ChebyshevMethod::MOST_STAGES);
        }
        ++iarg;
      } else
        error->all(FLERR, iarg + 1,
                   "Unknown fix rbc/ib integrator {}; allowed: euler, midpoint, ab2, rkc", value);
    } else if (keyword == "scheme") {
      if (value == "elastic")
        scheme = Scheme::ELASTIC;
      else if (value == "direct")
        scheme = Scheme::DIRECT;
      else
        error->all(FLERR, iarg + 1, "Unknown fix rbc/ib scheme {}; allowed: elastic, direct",
                   value);
    } else if (keyword == "tol") {
      direct.tolerance = utils::numeric(FLERR, value, false, lmp);
      if (!(direct.tolerance > 0 && direct.tolerance < 1))
        error->all(FLERR, iarg + 1, "Fix rbc/ib tol value {} must be between 0 and 1", value);
      iterates = true;
    } else if (keyword == "maxiter") {
      direct.max_solves = utils::inumeric(FLERR, value, false, lmp);
      if (direct.max_solves < 1)
        error->all(FLERR, iarg + 1, "Fix rbc/ib maxiter value {} must be > 0", value);
      iterates = true;
    } else if (keyword == "order") {
      order = utils::inumeric(FLERR, value, false, lmp);
      if (order != 2 && order != 3)
        error->all(FLERR, iarg + 1, "Fix rbc/ib order value {} must be 2 or 3", value);
    } else if (keyword == "courant")
      courant = positive(iarg + 1, keyword);
    else if (keyword == "adapt") {
      need(2, keyword);
      control.tolerance = positive(iarg + 1, "adapt error");
      control.largest = positive(iarg + 2, "adapt largest timestep");
      ++iarg;
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/ib keyword {}; allowed: kernel, scheme, integrator, order, tol, "
                 "maxiter, courant, adapt",
                 keyword);
    iarg += 2;
  }
  if (order > 2 && integrator != Integrator::RKC)
    error->all(FLERR, "Fix rbc/ib order {} needs integrator rkc", order);
  chebyshev = rbc::ChebyshevMethod(order);
  if (stages > 0) chebyshev.set_stages(stages);
  control.order = integrator == Integrator::EULER ? 1 : 2;
  control.growth = order > 2 ? LARGEST_GROWTH : 2;

  motion = std::make_unique<MarkerMotion>(lmp, fmt::format("Fix rbc/ib {}", id), groupbit, kernel);
  motion->courant = courant;
  motion->tolerance = direct.tolerance;
  motion->gmres.max_iterations = direct.max_solves;
}

/* ----------------------------------------------------------------------
   numbers kept for each atom
------------------------------------------------------------------------- */

int FixRBCIB::stored() const
{
  if (scheme == Scheme::DIRECT) return STEPS + 1;
  if (integrator == Integrator::AB2) return PAST + 3;
  return mode_column() + (automatic_stages ? 3 : 0);
}

/* ---------------------------------------------------------------------- */

FixRBCIB::~FixRBCIB()
{
  if (store && modify->nfix) modify->delete_fix(store_id);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::post_constructor()
{
  if (stored() == 0) return;
  store_id = std::string(id) + "_STORE_MOTION";
  store = dynamic_cast<FixStoreAtom *>(modify->add_fix(
      fmt::format("{} {} STORE/ATOM {} 0 0 1", store_id, group->names[igroup], stored())));
}

/* ----------------------------------------------------------------------
   a new atom has no past
------------------------------------------------------------------------- */

void FixRBCIB::set_arrays(int i)
{
  std::fill_n(store->astore[i], stored(), 0.0);
}

/* ---------------------------------------------------------------------- */

int FixRBCIB::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | POST_NEIGHBOR | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::init()
{
  fluid_fix = dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid_id));
  if (!fluid_fix)
    error->all(FLERR, "Fix rbc/ib {}: there is no fix rbc/fluid with ID {}", id, fluid_id);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/ib cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/ib cannot be used with minimize");
  const bool explicit_steps = integrator == Integrator::EULER || integrator == Integrator::MIDPOINT;
  if (fluid_fix->has_inertia() && !explicit_steps)
    error->all(FLERR,
               "Fix rbc/ib {}: fix rbc/fluid {} has inertia, for which integrator must be euler or "
               "midpoint",
               id, fluid_id);
  if (fluid_fix->has_inertia() && control.active())
    error->all(FLERR, "Fix rbc/ib {} adapt needs fix rbc/fluid {} inertia none", id, fluid_id);
  if (scheme == Scheme::DIRECT) {
    if (!fluid_fix->has_inertia())
      error->all(FLERR,
                 "Fix rbc/ib {} scheme direct needs a fluid with inertia: fix rbc/fluid {} "
                 "inertia unsteady or convective",
                 id, fluid_id);
    if (fluid_fix->flow().regime().scheme != fluid::Scheme::coupled)
      error->all(FLERR, "Fix rbc/ib {} scheme direct needs fix rbc/fluid {} scheme coupled", id,
                 fluid_id);
  }

  membranes.clear();
  bool viscous = false;
  late_forces = false;
  bool before = true;
  for (Fix *fix : modify->get_fix_list()) {
    if (fix == this) before = false;
    if (!before && (modify->get_fix_mask(fix) & POST_FORCE)) late_forces = true;
    auto membrane = dynamic_cast<FixRBCMembrane *>(fix);
    if (!membrane) continue;
    if (!before)
      error->all(FLERR, "Fix rbc/ib {} must be defined after fix rbc/membrane {}", id, fix->id);
    membranes.push_back(membrane);
    if (membrane->keeps_volume() || membrane->is_viscous()) check_moves_all(fix);
    viscous = viscous || membrane->is_viscous();
  }
  if (viscous && fluid_fix->has_inertia())
    error->all(FLERR, "Fix rbc/ib {}: membranes with viscosity need fix rbc/fluid {} inertia none",
               id, fluid_id);
  if (iterates && scheme != Scheme::DIRECT && !viscous)
    error->all(FLERR, "Fix rbc/ib tol and maxiter need scheme direct, integrator implicit or a fix "
                      "rbc/membrane with viscosity");
  motion->connect(fluid_fix, membranes);
  if (control.active()) {
    control.smallest = 1e-6 * control.largest;
    if (next_dt == 0) next_dt = std::min(update->dt, control.largest);
    set_timestep(next_dt);
  }
}

/* ----------------------------------------------------------------------
   keeping a cell's volume changes the velocities of all its vertices, and the viscosity of its membrane depends on them
------------------------------------------------------------------------- */

void FixRBCIB::check_moves_all(const Fix *membrane) const
{
  int left_out = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & membrane->groupbit) && !(atom->mask[i] & groupbit)) left_out = 1;
  MPI_Allreduce(MPI_IN_PLACE, &left_out, 1, MPI_INT, MPI_MAX, world);
  if (left_out)
    error->all(FLERR,
               "Fix rbc/ib {} does not move all atoms of fix rbc/membrane {}, which keeps the "
               "volume of its cells or has viscosity",
               id, membrane->id);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup_post_neighbor()
{
  post_neighbor();
}

void FixRBCIB::post_neighbor()
{
  motion->find_markers();
  if (integrator != Integrator::RKC || chebyshev.past_steps() == 0) return;
  known_steps = chebyshev.past_steps();
  for (int i : motion->members())
    known_steps = std::min(known_steps, static_cast<int>(store->astore[i][KNOWN]));
  MPI_Allreduce(MPI_IN_PLACE, &known_steps, 1, MPI_INT, MPI_MIN, world);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup(int /*vflag*/)
{
  fluid_fix->drive_at_setup();
  first_step = update->ntimestep;
  unconverged = rejected = motion->unconverged = 0;
  radius_step = -1;
  if (!fluid_fix->has_inertia())
    motion->update_velocities(Stage::START);
  else if (scheme == Scheme::ELASTIC && fluid_fix->flow().steps() == 0)
    motion->interpolate(Stage::START);
  motion->check_velocities();
  motion->reset_stopwatches();
  for (FixRBCMembrane *membrane : membranes) membrane->stopwatch.reset();
  first_solve = fluid_fix->solves();
  fluid_fix->count_from_here();
}

/* ----------------------------------------------------------------------
   velocities hold those of the flow at the start of the step
------------------------------------------------------------------------- */

void FixRBCIB::initial_integrate(int /*vflag*/)
{
  if (fluid_fix->has_inertia()) {
    advance_with_inertia();
    return;
  }
  if (late_forces && update->ntimestep == first_step + 1) motion->update_velocities(Stage::START);
  if (control.active()) set_timestep(std::min(next_dt, motion->longest_step()));

  motion->load(atom->x, start);
  motion->load(atom->v, velocity);
  bool again = false;
  do {
    fluid_fix->begin_step(again);
    advance();
    again = true;
  } while (control.active() && !accept_step());
  motion->store(position, atom->x);
  motion->check_positions();
  motion->stop->check();
  if (stored() > 0) remember();
  last_dt = update->dt;
}

/* ----------------------------------------------------------------------
   positions at the end of the step from those and the velocities at its start
------------------------------------------------------------------------- */

void FixRBCIB::advance()
{
  const double dt = update->dt;
  const auto move = [&](double span, const rbc::Numbers &by) {
    position.resize(start.size());
    for (std::size_t i = 0; i < start.size(); ++i) position[i] = start[i] + span * by[i];
  };

  if (integrator == Integrator::EULER)
    move(dt, velocity);
  else if (integrator == Integrator::MIDPOINT) {
    move(0.5 * dt, velocity);
    middle = velocity;
    motion->velocity(position, 0.5, middle);
    move(dt, middle);
  } else if (integrator == Integrator::AB2)
    advance_ab2();
  else
    advance_chebyshev();
}

/* ----------------------------------------------------------------------
   an atom without a past takes an Euler step
------------------------------------------------------------------------- */

void FixRBCIB::advance_ab2()
{
  const double dt = update->dt, ratio = last_dt > 0 ? 0.5 * dt / last_dt : 0;
  position.resize(start.size());
  const std::vector<int> &members = motion->members();
  for (std::size_t n = 0; n < members.size(); ++n) {
    const double *const past = store->astore[members[n]];
    const double weight = past[KNOWN] > 0 ? ratio : 0;

    for (int d = 0; d < 3; ++d) {
      const double now = velocity[3 * n + d];
      position[3 * n + d] = start[3 * n + d] + dt * (now + weight * (now - past[PAST + d]));
    }
  }
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::advance_chebyshev()
{
  if (automatic_stages && (radius_step < 0 || update->ntimestep >= radius_step + RADIUS_EVERY))
    estimate_radius();

  const int past_steps = chebyshev.past_steps();
  path.clear(past_steps);
  if (update->dt > LARGEST_GROWTH * past_dt[0]) known_steps = 0;
  for (int n = 0; n < known_steps; ++n) {
    path.span(n) = past_dt[n];
    motion->load(store->astore, path.moved(n), PAST + 3 * n);
  }
  path.set_steps(known_steps);
  if (known_steps < past_steps) {
    start_chebyshev();
    return;
  }
  choose_stages(update->dt);
  chebyshev.step(*motion, update->dt, start, velocity, path, position);
}

/* ----------------------------------------------------------------------
   order above 2: without a past the step is divided, so that it is as accurate as those that follow
------------------------------------------------------------------------- */

void FixRBCIB::start_chebyshev()
{
  const double part = 1.0 / STARTING_PARTS, dt = part * update->dt;
  const rbc::Path none;
  choose_stages(dt);
  position = start;
  middle = velocity;
  for (int n = 0; n < STARTING_PARTS; ++n) {
    if (n > 0) motion->velocity(position, n * part, middle);
    scratch = position;
    chebyshev.step(*motion, dt, scratch, middle, none, position, n * part, part);
  }
}

/* ----------------------------------------------------------------------
   what the next steps need to know of this one
------------------------------------------------------------------------- */

void FixRBCIB::remember()
{
  const std::vector<int> &members = motion->members();
  if (integrator == Integrator::AB2) {
    motion->store(velocity, store->astore, PAST);
    for (int i : members) store->astore[i][KNOWN] = 1;
    return;
  }
  const int past_steps = chebyshev.past_steps();
  if (past_steps == 0) return;
  known_steps = std::min(known_steps + 1, past_steps);
  std::rotate(past_dt.begin(), past_dt.end() - 1, past_dt.end());
  past_dt[0] = update->dt;
  for (std::size_t n = 0; n < members.size(); ++n) {
    double *const past = store->astore[members[n]];
    std::copy_backward(past + PAST, past + PAST + 3 * (past_steps - 1),
                       past + PAST + 3 * past_steps);
    for (int d = 0; d < 3; ++d) past[PAST + d] = position[3 * n + d] - start[3 * n + d];
    past[KNOWN] = known_steps;
  }
}

/* ----------------------------------------------------------------------
   integrator rkc auto
------------------------------------------------------------------------- */

void FixRBCIB::estimate_radius()
{
  motion->load(store->astore, middle, mode_column());
  if (!(dot(*motion, middle, middle) > 0)) {
    // a guess without any symmetry
    const std::vector<int> &members = motion->members();
    for (std::size_t i = 0; i < middle.size(); ++i)
      middle[i] = std::sin(1.0 + 12.9898 * static_cast<double>(i % 3) +
                           78.233 * static_cast<double>(atom->tag[members[i / 3]]));
  }
  const double size = RADIUS_DISPLACEMENT * fluid_fix->smallest_spacing() *
                      std::sqrt(dot(*motion, middle, middle)) / root_mean_square(*motion, middle);
  motion->probing = true;
  radius = RADIUS_SAFETY * spectrum.estimate(*motion, start, velocity, size, middle);
  motion->probing = false;
  if (!std::isfinite(radius))
    error->all(FLERR, "Fix rbc/ib {}: the spectral radius is not a number at step {}", id,
               update->ntimestep);
  motion->store(middle, store->astore, mode_column());
  radius_step = update->ntimestep;
}

void FixRBCIB::choose_stages(double dt)
{
  if (!automatic_stages) return;
  const int stages = chebyshev.stages_for(dt * radius);
  if (stages > rbc::ChebyshevMethod::MOST_STAGES)
    error->all(FLERR,
               "Fix rbc/ib {}: integrator rkc needs more than {} stages at step {}: the timestep "
               "{:.3g} is {:.3g} times the time in which the fastest mode relaxes",
               id, rbc::ChebyshevMethod::MOST_STAGES, update->ntimestep, dt, dt * radius);
  chebyshev.set_stages(stages);
}

/* ----------------------------------------------------------------------
   whether the local error is within its bound, and the timestep that this error suggests
------------------------------------------------------------------------- */

bool FixRBCIB::accept_step()
{
  middle = velocity;
  motion->velocity(position, 1.0, middle);
  velocities_known = true;
  last_error =
      rbc::StepControl::error(*motion, update->dt, start, position, velocity, middle, scratch);
  next_dt = control.next(update->dt, last_error);
  if (last_error <= control.tolerance) return true;

  ++rejected;
  if (next_dt < control.smallest)
    error->all(
        FLERR,
        "Fix rbc/ib {}: no timestep above {:.3g} meets the error {:.3g} of adapt at step {}; "
        "the local error is {:.3g}",
        id, control.smallest, control.tolerance, update->ntimestep, last_error);
  set_timestep(next_dt);
  return false;
}

/* ----------------------------------------------------------------------
   of the step that ends at update->ntimestep, as fix dt/reset does
------------------------------------------------------------------------- */

void FixRBCIB::set_timestep(double dt)
{
  if (dt == update->dt) return;
  const bigint begin = std::max(update->ntimestep - (update->setupflag ? 0 : 1), update->atimestep);
  update->atime += (begin - update->atimestep) * update->dt;
  update->atimestep = begin;
  update->dt = dt;
  update->dt_default = 0;
  if (force->pair) force->pair->reset_dt();
  for (Fix *fix : modify->get_fix_list()) fix->reset_dt();
  output->reset_dt();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::final_integrate()
{
  if (fluid_fix->has_inertia()) return;
  fluid_fix->drive_now();
  if (velocities_known)
    motion->keep_volume(Stage::START);
  else
    motion->update_velocities(Stage::START);
  velocities_known = false;
}

/* ----------------------------------------------------------------------
   velocities hold those in the middle of the last step (fluid velocities at the end of a step may ring, see
   Crank-Nicolson; good to second order for half a step)
------------------------------------------------------------------------- */

void FixRBCIB::advance_with_inertia()
{
  fluid_fix->begin_step();
  fluid_fix->drive_at(0.5);
  motion->load(atom->x, start);
  const auto move = [this](double span) {
    motion->load(atom->v, velocity);
    position.resize(start.size());
    for (std::size_t i = 0; i < start.size(); ++i) position[i] = start[i] + span * velocity[i];
    motion->store(position, atom->x);
    motion->check_positions();
    motion->stop->check();
  };
  if (integrator == Integrator::MIDPOINT) {
    move(0.5 * update->dt);
    motion->recompute_forces();
  }
  step_fluid();
  move(update->dt);
}

/* ----------------------------------------------------------------------
   the fluid's step, with the atoms' forces and velocities in its middle
------------------------------------------------------------------------- */

void FixRBCIB::step_fluid()
{
  fluid::Flow &flow = fluid_fix->flow();
  if (scheme == Scheme::ELASTIC) {
    motion->spread_forces();
    motion->solving.start();
    flow.start_step(update->dt);
    motion->solving.stop();
    motion->interpolate(Stage::START);
  } else {
    motion->solving.start();
    couple_masses();
    motion->solving.stop();
    motion->keep_volume(Stage::START);
  }
  motion->check_velocities();
  motion->solving.start();
  fluid_fix->drive_end();
  flow.finish_step();
  fluid_fix->flow_changed();
  motion->solving.stop();
}

/* ----------------------------------------------------------------------
   scheme direct: the acceleration of the masses by a backward difference of second order over the velocities in the
   middle of this and the last two steps; over fewer at first, from the atoms' own velocities on
------------------------------------------------------------------------- */

void FixRBCIB::couple_masses()
{
  const double dt = update->dt;
  double **const history = store->astore;
  const std::size_t numbers = 3 * static_cast<std::size_t>(atom->nlocal);
  for (auto *vector : {&applied, &target, &inertial}) vector->resize(numbers);
  resistance.resize(atom->nlocal);

  const double between = 0.5 * (dt + last_dt);    // the middles of this step and the last
  for (int i : motion->members()) {
    const double mass = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    if (!(mass > 0))
      motion->report(i, fmt::format("has mass {}; scheme direct needs a mass > 0", mass));
    const int steps = static_cast<int>(history[i][STEPS]);
    const double span = steps == 0 ? 0.5 * dt : between;
    const double r = steps > 1 ? span / last_between : 1;
    const double own = steps > 1 ? (1 + 2 * r) / (1 + r) : 1;    // coefficients, times span, of
    const double last = steps > 1 ? 1 + r : 1;                   // the three velocities
    const double older = steps > 1 ? r * r / (1 + r) : 0;
    resistance[i] = mass * own / span;
    for (int d = 0; d < 3; ++d) {
      const double velocity = atom->v[i][d] + history[i][MISSING + d];
      target[3 * i + d] = (last * velocity - older * history[i][OLDER + d]) / own;
      applied[3 * i + d] = atom->f[i][d] * force->ftm2v;
      inertial[3 * i + d] = history[i][INERTIAL + d];
      history[i][OLDER + d] = velocity;
    }
    history[i][STEPS] = std::min(steps + 1, 2);
  }
  motion->stop->check();

  const auto outcome = direct.advance(fluid_fix->flow(), dt,
                                      {kernel, motion->markers(), motion->rows(atom->x),
                                       applied.data(), resistance.data(), target.data(),
                                       inertial.data(), motion->rows(atom->v), atom->nlocal});
  if (outcome.outside >= 0) motion->report_outside(outcome.outside);
  motion->stop->check();
  coupling_error = outcome.error;
  if (!(outcome.error <= direct.tolerance)) ++unconverged;

  for (double &sum : exerted) sum = 0;
  for (int i : motion->members())
    for (int d = 0; d < 3; ++d) {
      history[i][INERTIAL + d] = inertial[3 * i + d];
      history[i][MISSING + d] =
          target[3 * i + d] - inertial[3 * i + d] / resistance[i] - atom->v[i][d];
      exerted[d] += applied[3 * i + d] + inertial[3 * i + d];
    }
  last_dt = dt;
  last_between = between;
}

/* ----------------------------------------------------------------------
   1-3 force of the atoms on the fluid, 4 error of the coupling, 5 stages, 6 spectral radius, 7 local error, 8 steps
   taken again, 9 timestep: of the last step
------------------------------------------------------------------------- */

double FixRBCIB::compute_vector(int n)
{
  switch (n) {
    case 3:
      return coupling_error;
    case 4:
      return integrator == Integrator::RKC ? chebyshev.stages() : 0;
    case 5:
      return radius;
    case 6:
      return last_error;
    case 7:
      return static_cast<double>(rejected);
    case 8:
      return last_dt;
  }
  double sum = 0;
  if (scheme == Scheme::DIRECT)
    sum = exerted[n] / force->ftm2v;
  else
    for (int i : motion->members()) sum += atom->f[i][n];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  double state[NSTATE] = {last_dt, last_between, next_dt};
  std::copy(past_dt.begin(), past_dt.end(), state + 3);
  const int size = sizeof(state);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state, sizeof(double), NSTATE, fp);
}

void FixRBCIB::restart(char *buffer)
{
  const auto state = reinterpret_cast<const double *>(buffer);
  last_dt = state[0];
  last_between = state[1];
  next_dt = state[2];
  std::copy_n(state + 3, past_dt.size(), past_dt.begin());
}

/* ----------------------------------------------------------------------
   cost of a solve with all that belongs to it, summed over ranks
------------------------------------------------------------------------- */

void FixRBCIB::post_run()
{
  const bigint solves = fluid_fix->solves() - first_solve;
  if (solves == 0) return;
  double membrane = 0;
  for (const FixRBCMembrane *fix : membranes) membrane += fix->stopwatch.seconds();
  double seconds[5] = {membrane, motion->spreading.seconds(), motion->solving.seconds(),
                       motion->interpolating.seconds(), motion->exchanging.seconds()};
  MPI_Allreduce(MPI_IN_PLACE, seconds, 5, MPI_DOUBLE, MPI_SUM, world);
  bigint mine = static_cast<bigint>(motion->members().size()), vertices;
  MPI_Allreduce(&mine, &vertices, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const bigint steps = update->ntimestep - first_step;
  const std::string costs = fluid_fix->costs(steps);
  if (comm->me != 0) return;

  const double cells = static_cast<double>(fluid_fix->flow().grid().size());
  const double sum = seconds[0] + seconds[1] + seconds[2] + seconds[3] + seconds[4];
  std::string text =
      fmt::format("\nUSER-RBC step cost: {} solves in {} steps, {} vertices, {:.0f} fluid cells, "
                  "{} MPI task{}\n"
                  "Section     | core s/solve | us/vertex | ns/cell | %share\n"
                  "-------------------------------------------------------\n",
                  solves, steps, vertices, cells, comm->nprocs, comm->nprocs > 1 ? "s" : "");
  const char *const names[5] = {"Membrane", "Spread", "Solve", "Interpolate", "Exchange"};
  for (int n = 0; n <= 5; ++n) {
    const double each = (n < 5 ? seconds[n] : sum) / solves;
    text += fmt::format(
        "{:<11} | {:12.5g} | {:9.4g} | {:7.4g} | {:6.2f}\n", n < 5 ? names[n] : "Total", each,
        vertices > 0 ? each / vertices * 1e6 : 0.0, each / cells * 1e9, 100 * each * solves / sum);
  }
  utils::logmesg(lmp, text + costs);
  if (unconverged > 0)
    error->warning(FLERR, "Fix rbc/ib {} reached its maxiter of {} in {} steps", id,
                   direct.max_solves, unconverged);
  if (motion->unconverged > 0)
    error->warning(FLERR, "Fix rbc/ib {} reached its maxiter of {} in {} evaluations", id,
                   direct.max_solves, motion->unconverged);
}

/* ---------------------------------------------------------------------- */

double FixRBCIB::memory_usage()
{
  std::size_t numbers = direct.numbers() + motion->numbers() + chebyshev.numbers() + path.numbers();
  for (const auto *vector :
       {&start, &velocity, &middle, &position, &scratch, &applied, &resistance, &target, &inertial})
    numbers += vector->capacity();
  return static_cast<double>(motion->members().capacity() * sizeof(int) + numbers * sizeof(double));
}
