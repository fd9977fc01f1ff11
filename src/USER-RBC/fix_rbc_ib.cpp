#include "fix_rbc_ib.h"

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "dihedral.h"
#include "domain.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "fix_rbc_membrane.h"
#include "fix_store_atom.h"
#include "force.h"
#include "group.h"
#include "improper.h"
#include "kspace.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixRBCIB::FixRBCIB(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  time_integrate = 1;

  if (narg < 4) utils::missing_cmd_args(FLERR, "fix rbc/ib", error);
  fluid_id = arg[3];
  int iarg = 4;
  bool direct_options = false;
  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix rbc/ib " + keyword, error);
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
      else
        error->all(FLERR, iarg + 1, "Unknown fix rbc/ib integrator {}; allowed: euler, midpoint",
                   value);
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
      direct_options = true;
    } else if (keyword == "maxiter") {
      direct.max_solves = utils::inumeric(FLERR, value, false, lmp);
      if (direct.max_solves < 1)
        error->all(FLERR, iarg + 1, "Fix rbc/ib maxiter value {} must be > 0", value);
      direct_options = true;
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/ib keyword {}; allowed: kernel, scheme, integrator, tol, maxiter",
                 keyword);
    iarg += 2;
  }
  if (direct_options && scheme != Scheme::DIRECT)
    error->all(FLERR, "Fix rbc/ib tol and maxiter need scheme direct");

  if (scheme == Scheme::DIRECT) {
    restart_global = 1;
    create_attribute = 1;
    vector_flag = 1;
    size_vector = 4;
    global_freq = 1;
    extvector = 0;
  }
}

/* ---------------------------------------------------------------------- */

FixRBCIB::~FixRBCIB()
{
  if (store && modify->nfix) modify->delete_fix(store_id);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::post_constructor()
{
  if (scheme != Scheme::DIRECT) return;
  store_id = std::string(id) + "_STORE_MOTION";
  store = dynamic_cast<FixStoreAtom *>(modify->add_fix(
      fmt::format("{} {} STORE/ATOM {} 0 0 1", store_id, group->names[igroup], NSTORED)));
}

/* ----------------------------------------------------------------------
   a new atom has no past
------------------------------------------------------------------------- */

void FixRBCIB::set_arrays(int i)
{
  std::fill_n(store->astore[i], NSTORED, 0.0);
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
  keepers.clear();
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
    if (!membrane->keeps_volume()) continue;
    check_moves_all(fix);
    keepers.push_back(membrane);
  }
}

/* ----------------------------------------------------------------------
   keeping a cell's volume changes the velocities of all its vertices
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
               "volume of its cells",
               id, membrane->id);
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup_post_neighbor()
{
  post_neighbor();
}

void FixRBCIB::post_neighbor()
{
  members.clear();
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit) members.push_back(i);
  start_of_step.resize(3 * members.size());
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::setup(int /*vflag*/)
{
  fluid_fix->drive_at_setup();
  first_step = update->ntimestep;
  unconverged = 0;
  if (!fluid_fix->has_inertia())
    update_velocities(Stage::START);
  else if (scheme == Scheme::ELASTIC && fluid_fix->flow().steps() == 0)
    interpolate(Stage::START);
  else
    check_velocities();
  for (rbc::Stopwatch *watch : {&spreading, &solving, &interpolating, &exchanging}) watch->reset();
  for (FixRBCMembrane *membrane : membranes) membrane->stopwatch.reset();
  first_solve = fluid_fix->solves();
  fluid_fix->count_from_here();
}

/* ----------------------------------------------------------------------
   velocities hold those of the flow at the start of the step; with inertia, those in the middle of the last step
   (fluid velocities at the end of a step may ring, see Crank-Nicolson; good to second order for half a step)
------------------------------------------------------------------------- */

void FixRBCIB::initial_integrate(int /*vflag*/)
{
  const bool steady = !fluid_fix->has_inertia();
  if (steady && late_forces && update->ntimestep == first_step + 1) update_velocities(Stage::START);

  const double *const x = members.empty() ? nullptr : atom->x[0];
  const int count = static_cast<int>(members.size());
  for (int n = 0; n < count; ++n)
    for (int d = 0; d < 3; ++d) start_of_step[3 * n + d] = x[3 * members[n] + d];

  if (integrator == Integrator::MIDPOINT) {
    move(0.5 * update->dt);
    check_positions();
    fluid_fix->drive_middle();
    exchanging.start();
    comm->forward_comm();
    exchanging.stop();
    recompute_forces();
    if (steady) update_velocities(Stage::MIDDLE);
  } else if (!steady)
    fluid_fix->drive_middle();
  if (!steady) step_fluid();

  move(update->dt);
  check_positions();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::move(double span)
{
  double *const x = members.empty() ? nullptr : atom->x[0];
  const double *const v = members.empty() ? nullptr : atom->v[0];
  const int count = static_cast<int>(members.size());
  for (int n = 0; n < count; ++n)
    for (int d = 0; d < 3; ++d)
      x[3 * members[n] + d] = start_of_step[3 * n + d] + span * v[3 * members[n] + d];
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::final_integrate()
{
  if (fluid_fix->has_inertia()) return;
  fluid_fix->drive_now();
  update_velocities(Stage::START);
}

/* ----------------------------------------------------------------------
   forces at positions within a step, as Verlet computes them at its end
------------------------------------------------------------------------- */

void FixRBCIB::recompute_forces()
{
  const std::size_t count = atom->nlocal + (force->newton ? atom->nghost : 0);
  if (count) memset(atom->f[0], 0, 3 * count * sizeof(double));

  constexpr int eflag = 0, vflag = 0;
  if (modify->n_pre_force) modify->pre_force(vflag);
  if (force->pair && force->pair->compute_flag) force->pair->compute(eflag, vflag);
  if (atom->molecular != Atom::ATOMIC) {
    if (force->bond) force->bond->compute(eflag, vflag);
    if (force->angle) force->angle->compute(eflag, vflag);
    if (force->dihedral) force->dihedral->compute(eflag, vflag);
    if (force->improper) force->improper->compute(eflag, vflag);
  }
  if (force->kspace && force->kspace->compute_flag) force->kspace->compute(eflag, vflag);
  if (modify->n_pre_reverse) modify->pre_reverse(eflag, vflag);
  if (force->newton) comm->reverse_comm();
  if (modify->n_post_force_any) modify->post_force(vflag);
}

/* ----------------------------------------------------------------------
   forces -> spread -> solve -> interpolate -> velocities
------------------------------------------------------------------------- */

void FixRBCIB::update_velocities(Stage stage)
{
  spread_forces();

  solving.start();
  fluid_fix->flow().solve();
  fluid_fix->flow_changed();
  solving.stop();

  interpolate(stage);
}

/* ----------------------------------------------------------------------
   the fluid's step, with the atoms' forces and velocities in its middle
------------------------------------------------------------------------- */

void FixRBCIB::step_fluid()
{
  fluid::Flow &flow = fluid_fix->flow();
  if (scheme == Scheme::ELASTIC) {
    spread_forces();
    solving.start();
    flow.start_step(update->dt);
    solving.stop();
    interpolate(Stage::START);
  } else {
    solving.start();
    couple_masses();
    solving.stop();
    for (FixRBCMembrane *membrane : keepers) membrane->keep_volume(update->dt, true, true);
    check_velocities();
  }
  solving.start();
  fluid_fix->drive_end();
  flow.finish_step();
  fluid_fix->flow_changed();
  solving.stop();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::spread_forces()
{
  fluid::Flow &flow = fluid_fix->flow();
  spreading.start();
  flow.clear_force();
  const int outside = flow.spread(kernel, markers(), rows(atom->x), rows(atom->f), force->ftm2v);
  if (outside >= 0) stop_outside(outside);
  spreading.stop();

  exchanging.start();
  flow.gather_force();
  exchanging.stop();
}

/* ----------------------------------------------------------------------
   atoms take the velocity of the fluid
------------------------------------------------------------------------- */

void FixRBCIB::interpolate(Stage stage)
{
  fluid::Flow &flow = fluid_fix->flow();
  exchanging.start();
  flow.share_velocity();
  exchanging.stop();

  interpolating.start();
  flow.interpolate(kernel, markers(), rows(atom->x), rows(atom->v));
  interpolating.stop();

  const bool mid_step = stage == Stage::MIDDLE || fluid_fix->has_inertia();
  for (FixRBCMembrane *membrane : keepers)
    membrane->keep_volume(update->dt, stage == Stage::START, mid_step);
  check_velocities();
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
  for (int i : members) {
    const double mass = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    if (!(mass > 0)) stop(i, fmt::format("has mass {}; scheme direct needs a mass > 0", mass));
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

  const auto outcome =
      direct.advance(fluid_fix->flow(), dt,
                     {kernel, markers(), rows(atom->x), applied.data(), resistance.data(),
                      target.data(), inertial.data(), rows(atom->v), atom->nlocal});
  if (outcome.outside >= 0) stop_outside(outcome.outside);
  last_error = outcome.error;
  if (!(outcome.error <= direct.tolerance)) ++unconverged;

  for (double &sum : exerted) sum = 0;
  for (int i : members)
    for (int d = 0; d < 3; ++d) {
      history[i][INERTIAL + d] = inertial[3 * i + d];
      history[i][MISSING + d] =
          target[3 * i + d] - inertial[3 * i + d] / resistance[i] - atom->v[i][d];
      exerted[d] += applied[3 * i + d] + inertial[3 * i + d];
    }
  last_dt = dt;
  last_between = between;
}

/* ---------------------------------------------------------------------- */

fluid::Markers FixRBCIB::markers() const
{
  return {static_cast<int>(members.size()), members.data()};
}

double *FixRBCIB::rows(double **array) const
{
  return members.empty() ? nullptr : array[0];
}

void FixRBCIB::stop_outside(int i) const
{
  stop(i, "left the fluid its MPI task holds (reneighboring too rare, see neigh_modify)");
}

/* ----------------------------------------------------------------------
   scheme direct: 1-3 force of the atoms on the fluid, 4 error of the coupling in the last step
------------------------------------------------------------------------- */

double FixRBCIB::compute_vector(int n)
{
  if (n == 3) return last_error;
  double sum = exerted[n] / force->ftm2v;
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  const double state[2] = {last_dt, last_between};
  const int size = sizeof(state);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state, sizeof(double), 2, fp);
}

void FixRBCIB::restart(char *buffer)
{
  const auto state = reinterpret_cast<const double *>(buffer);
  last_dt = state[0];
  last_between = state[1];
}

/* ----------------------------------------------------------------------
   LAMMPS would delete what is beyond a plate when atoms migrate
------------------------------------------------------------------------- */

void FixRBCIB::check_positions() const
{
  if (domain->zperiodic) return;
  double **const x = atom->x;
  for (int i : members)
    if (x[i][2] < domain->boxlo[2] || x[i][2] >= domain->boxhi[2]) stop(i, "went through a plate");
}

/* ----------------------------------------------------------------------
   no vertex may cross more than a cell of the fluid in a step
------------------------------------------------------------------------- */

void FixRBCIB::check_velocities() const
{
  const double fastest = fluid_fix->smallest_spacing() / update->dt;
  double **const v = atom->v;
  for (int i : members) {
    const double speed2 = v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2];
    if (speed2 <= fastest * fastest) continue;
    if (std::isfinite(speed2))
      stop(i, fmt::format("would cross {:.3g} fluid cells in a step (CFL above 1; timestep too "
                          "large or unstable)",
                          std::sqrt(speed2) / fastest));
    stop(i, "has a velocity that is not a number");
  }
}

void FixRBCIB::stop(int i, const std::string &what) const
{
  double **const x = atom->x;
  error->one(FLERR,
             "Fix rbc/ib {}: vertex with atom ID {} {} at step {}: molecule ID {} at ({:.6g}, "
             "{:.6g}, {:.6g})",
             id, atom->tag[i], what, update->ntimestep, atom->molecule_flag ? atom->molecule[i] : 0,
             x[i][0], x[i][1], x[i][2]);
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
  double seconds[5] = {membrane, spreading.seconds(), solving.seconds(), interpolating.seconds(),
                       exchanging.seconds()};
  MPI_Allreduce(MPI_IN_PLACE, seconds, 5, MPI_DOUBLE, MPI_SUM, world);
  bigint mine = static_cast<bigint>(members.size()), vertices;
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
}

/* ---------------------------------------------------------------------- */

double FixRBCIB::memory_usage()
{
  std::size_t numbers = start_of_step.capacity() + direct.numbers();
  for (const auto *vector : {&applied, &resistance, &target, &inertial})
    numbers += vector->capacity();
  return static_cast<double>(members.capacity() * sizeof(int) + numbers * sizeof(double));
}
