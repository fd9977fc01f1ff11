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
#include "pair_rbc_jkr.h"
#include "rbc_rigid_walls.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

using namespace LAMMPS_NS;
using namespace FixConst;

// numbers in restart files

static constexpr int NSTATE = 2 + SteadySteps::NSTATE;

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
  if (stored() > 0 || steady->adaptive()) restart_global = 1;
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::parse(int narg, char **arg)
{
  double courant = 1, error_bound = 0, largest_dt = 0;
  Integrator integrator = Integrator::MIDPOINT;
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
        if (strcmp(arg[iarg + 2], "auto") != 0) {
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
    } else if (keyword == "sheets")
      sheets = utils::logical(FLERR, value, false, lmp) == 1 ? Sheets::YES : Sheets::NO;
    else if (keyword == "courant")
      courant = positive(iarg + 1, keyword);
    else if (keyword == "adapt") {
      need(2, keyword);
      error_bound = positive(iarg + 1, "adapt error");
      largest_dt = positive(iarg + 2, "adapt largest timestep");
      ++iarg;
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/ib keyword {}; allowed: kernel, scheme, integrator, order, tol, "
                 "maxiter, courant, adapt, sheets",
                 keyword);
    iarg += 2;
  }
  if (order > 2 && integrator != Integrator::RKC)
    error->all(FLERR, "Fix rbc/ib order {} needs integrator rkc", order);
  if (sheets == Sheets::YES && scheme == Scheme::DIRECT)
    error->all(FLERR, "Fix rbc/ib sheets yes needs scheme elastic");

  motion = std::make_unique<MarkerMotion>(lmp, fmt::format("Fix rbc/ib {}", id), groupbit, kernel);
  motion->courant = courant;
  motion->tolerance = direct.tolerance;
  motion->gmres.max_iterations = direct.max_solves;
  steady = std::make_unique<SteadySteps>(lmp, fmt::format("Fix rbc/ib {}", id), *motion);
  steady->choose(integrator, stages, order, error_bound, largest_dt);
}

/* ----------------------------------------------------------------------
   numbers kept for each atom
------------------------------------------------------------------------- */

int FixRBCIB::stored() const
{
  if (scheme == Scheme::DIRECT) return STEPS + 1;
  return steady->numbers_per_atom();
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
  // what is stored differs: a restart file of another method must not be taken for this one's
  const bool direct_scheme = scheme == Scheme::DIRECT;
  store_id = fmt::format("{}_STORE_{}_{}", id,
                         direct_scheme ? 10 : static_cast<int>(steady->method()), stored());
  store = dynamic_cast<FixStoreAtom *>(modify->add_fix(
      fmt::format("{} {} STORE/ATOM {} 0 0 1", store_id, group->names[igroup], stored())));
  steady->keep_in(store);
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
  inertia = fluid_fix->has_inertia();
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/ib cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/ib cannot be used with minimize");
  const bool explicit_steps =
      steady->method() == Integrator::EULER || steady->method() == Integrator::MIDPOINT;
  if (fluid_fix->has_inertia() && !explicit_steps)
    error->all(FLERR,
               "Fix rbc/ib {}: fix rbc/fluid {} has inertia, for which integrator must be euler or "
               "midpoint",
               id, fluid_id);
  if (fluid_fix->has_inertia() && steady->adaptive())
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
    if (before && steady->adaptive() && (modify->get_fix_mask(fix) & INITIAL_INTEGRATE))
      error->all(
          FLERR,
          "Fix rbc/ib {} with adapt must be defined before fix {} {}, which moves atoms by the "
          "timestep",
          id, fix->style, fix->id);
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
    error->all(FLERR, "Fix rbc/ib tol and maxiter need scheme direct or a fix rbc/membrane with "
                      "viscosity");
  for (const Fix *wall : modify->get_fix_by_style("^rbc/wall$")) check_apart(wall);
  motion->as = has_sheets() ? fluid::Flow::As::sheets : fluid::Flow::As::points;
  motion->connect(fluid_fix, membranes);
  steady->start_run(fluid_fix, late_forces);
}

/* ---------------------------------------------------------------------- */

bool FixRBCIB::has_sheets() const
{
  if (sheets != Sheets::WITH_MEMBRANES) return sheets == Sheets::YES;
  return scheme == Scheme::ELASTIC && !modify->get_fix_by_style("^rbc/membrane$").empty();
}

/* ----------------------------------------------------------------------
   keeping a cell's volume changes the velocities of all its vertices, and the viscosity of its membrane depends on them
------------------------------------------------------------------------- */

void FixRBCIB::check_moves_all(const Fix *membrane) const
{
  int left_out = 0;
  int moved = groupbit;    // or held
  for (const Fix *wall : modify->get_fix_by_style("^rbc/wall$")) moved |= wall->groupbit;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & membrane->groupbit) && !(atom->mask[i] & moved)) left_out = 1;
  MPI_Allreduce(MPI_IN_PLACE, &left_out, 1, MPI_INT, MPI_MAX, world);
  if (left_out)
    error->all(FLERR,
               "Fix rbc/ib {} does not move all atoms of fix rbc/membrane {}, which keeps the "
               "volume of its cells or has viscosity",
               id, membrane->id);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::check_apart(const Fix *wall) const
{
  int shared = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & wall->groupbit) && (atom->mask[i] & groupbit)) shared = 1;
  MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, world);
  if (shared)
    error->all(FLERR,
               "Fix rbc/ib {} would move atoms of fix rbc/wall {}: their groups must have no atoms "
               "in common",
               id, wall->id);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup_post_neighbor()
{
  post_neighbor();
}

void FixRBCIB::post_neighbor()
{
  motion->find_markers();
  steady->atoms_migrated();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup(int /*vflag*/)
{
  fluid_fix->drive_at_setup();
  first_step = update->ntimestep;
  unconverged = motion->unconverged = 0;
  if (!fluid_fix->has_inertia()) {
    motion->update_velocities(Stage::START);
    for (bool again = fluid_fix->holds_inside(); again;) {
      again = fluid_fix->correct_drive();
      motion->recompute_forces();
      motion->update_velocities(Stage::START);
    }
  } else if (scheme == Scheme::ELASTIC && fluid_fix->flow().steps() == 0)
    motion->interpolate(Stage::START);
  motion->check_velocities(Stage::START);
  motion->reset_stopwatches();
  for (FixRBCMembrane *membrane : membranes) membrane->stopwatch.reset();
  contacts = PairRBCJKR::all(force);
  for (PairRBCJKR *contact : contacts) {
    contact->finding.reset();
    contact->interacting.reset();
  }
  first_solve = fluid_fix->solves();
  fluid_fix->count_from_here();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::initial_integrate(int /*vflag*/)
{
  if (inertia)
    advance_with_inertia();
  else
    steady->advance();
}

void FixRBCIB::final_integrate()
{
  if (!inertia) steady->finish();
  motion->stop->check();
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
  if (steady->method() == Integrator::MIDPOINT) {
    move(0.5 * update->dt);
    motion->recompute_forces();
  }
  step_fluid();
  move(update->dt);
  last_dt = update->dt;
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
  motion->check_velocities(Stage::MIDDLE);
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
      return steady->stages();
    case 5:
      return steady->radius();
    case 6:
      return steady->local_error();
    case 7:
      return static_cast<double>(steady->rejected());
    case 8:
      return inertia ? last_dt : steady->last_dt();
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
  double state[NSTATE] = {last_dt, last_between};
  const SteadySteps::State steps = steady->state();
  std::copy(steps.begin(), steps.end(), state + 2);
  const int size = sizeof(state);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state, sizeof(double), NSTATE, fp);
}

void FixRBCIB::restart(char *buffer)
{
  const auto state = reinterpret_cast<const double *>(buffer);
  last_dt = state[0];
  last_between = state[1];
  steady->restart(state + 2);
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
  std::vector<std::string> names = {"Membrane", "Spread", "Solve", "Interpolate", "Exchange"};
  std::vector<double> seconds = {membrane, motion->spreading.seconds(), motion->solving.seconds(),
                                 motion->interpolating.seconds(), motion->exchanging.seconds()};
  if (!contacts.empty()) {
    double finding = 0, interacting = 0;
    for (const PairRBCJKR *contact : contacts) {
      finding += contact->finding.seconds();
      interacting += contact->interacting.seconds();
    }
    names.insert(names.begin() + 1, {"Detection", "Contact"});
    seconds.insert(seconds.begin() + 1, {finding, interacting});
  }
  if (const RigidWalls *const walls = fluid_fix->rigid_walls()) {
    names.emplace_back("Walls");
    seconds.push_back(walls->stopwatch.seconds());
  }
  names.emplace_back("Total");
  seconds.push_back(std::accumulate(seconds.begin(), seconds.end(), 0.0));
  MPI_Allreduce(MPI_IN_PLACE, seconds.data(), static_cast<int>(seconds.size()), MPI_DOUBLE, MPI_SUM,
                world);
  bigint mine = static_cast<bigint>(motion->members().size()), vertices;
  MPI_Allreduce(&mine, &vertices, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const bigint steps = update->ntimestep - first_step;
  const std::string costs = fluid_fix->costs(steps);
  if (comm->me != 0) return;

  const double cells = static_cast<double>(fluid_fix->flow().grid().size());
  std::string text =
      fmt::format("\nUSER-RBC step cost: {} solves in {} steps, {} vertices, {:.0f} fluid cells, "
                  "{} MPI task{}\n"
                  "Section     | core s/solve | us/vertex | ns/cell | %share\n"
                  "-------------------------------------------------------\n",
                  solves, steps, vertices, cells, comm->nprocs, comm->nprocs > 1 ? "s" : "");
  for (std::size_t n = 0; n < names.size(); ++n) {
    const double each = seconds[n] / solves;
    text += fmt::format("{:<11} | {:12.5g} | {:9.4g} | {:7.4g} | {:6.2f}\n", names[n], each,
                        vertices > 0 ? each / vertices * 1e6 : 0.0, each / cells * 1e9,
                        100 * seconds[n] / seconds.back());
  }
  text += costs;
  if (steady->rejected() > 0)
    text += fmt::format("Steps taken again: {}, {} of them gone wrong\n", steady->rejected(),
                        steady->failed());
  if (steady->failed() > 0) text += fmt::format("The last: {}\n", steady->last_failure());
  utils::logmesg(lmp, text);
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
  std::size_t numbers = direct.numbers() + motion->numbers() + steady->numbers();
  for (const auto *vector :
       {&start, &velocity, &position, &applied, &resistance, &target, &inertial})
    numbers += vector->capacity();
  return static_cast<double>(motion->members().capacity() * sizeof(int) + numbers * sizeof(double));
}
