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
#include "force.h"
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
      if (value != "elastic")
        error->all(FLERR, iarg + 1, "Fix rbc/ib scheme {} is not available; allowed: elastic",
                   value);
    } else
      error->all(FLERR, iarg, "Unknown fix rbc/ib keyword {}; allowed: kernel, scheme, integrator",
                 keyword);
    iarg += 2;
  }
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
  fluid_fix->update_drive(false);
  update_velocities(Stage::START);
  for (rbc::Stopwatch *watch : {&spreading, &solving, &interpolating, &exchanging}) watch->reset();
  for (FixRBCMembrane *membrane : membranes) membrane->stopwatch.reset();
  first_solve = fluid_fix->solves();
  first_step = update->ntimestep;
}

/* ----------------------------------------------------------------------
   velocities hold those of the flow at the start of the step
------------------------------------------------------------------------- */

void FixRBCIB::initial_integrate(int /*vflag*/)
{
  if (late_forces && update->ntimestep == first_step + 1) update_velocities(Stage::START);

  double *const x = members.empty() ? nullptr : atom->x[0];
  const double dt = update->dt;
  const int count = static_cast<int>(members.size());

  const auto move = [&](double span) {
    const double *const v = members.empty() ? nullptr : atom->v[0];
    for (int n = 0; n < count; ++n)
      for (int d = 0; d < 3; ++d)
        x[3 * members[n] + d] = start_of_step[3 * n + d] + span * v[3 * members[n] + d];
  };

  for (int n = 0; n < count; ++n)
    for (int d = 0; d < 3; ++d) start_of_step[3 * n + d] = x[3 * members[n] + d];
  if (integrator == Integrator::MIDPOINT) {
    move(0.5 * dt);
    check_positions();
    fluid_fix->update_drive(true);
    exchanging.start();
    comm->forward_comm();
    exchanging.stop();
    recompute_forces();
    update_velocities(Stage::MIDDLE);
  }
  move(dt);
  check_positions();
}

/* ---------------------------------------------------------------------- */

void FixRBCIB::final_integrate()
{
  fluid_fix->update_drive(false);
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
  fluid::Flow &flow = fluid_fix->flow();
  const fluid::Markers markers{static_cast<int>(members.size()), members.data()};
  const double *x = members.empty() ? nullptr : atom->x[0];
  const double *f = members.empty() ? nullptr : atom->f[0];
  double *v = members.empty() ? nullptr : atom->v[0];

  spreading.start();
  flow.clear_force();
  const int outside = flow.spread(kernel, markers, x, f, force->ftm2v);
  if (outside >= 0)
    stop(outside, "left the fluid its MPI task holds (reneighboring too rare, see neigh_modify)");
  spreading.stop();

  exchanging.start();
  flow.gather_force();
  exchanging.stop();

  solving.start();
  flow.solve();
  fluid_fix->solved();
  solving.stop();

  exchanging.start();
  flow.share_velocity();
  exchanging.stop();

  interpolating.start();
  flow.interpolate(kernel, markers, x, v);
  interpolating.stop();

  for (FixRBCMembrane *membrane : keepers) membrane->keep_volume(update->dt, stage == Stage::START);
  check_velocities();
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
  if (comm->me != 0) return;

  const double cells = static_cast<double>(fluid_fix->flow().grid().size());
  const double sum = seconds[0] + seconds[1] + seconds[2] + seconds[3] + seconds[4];
  const bigint steps = update->ntimestep - first_step;
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
  utils::logmesg(lmp, text);
}

/* ---------------------------------------------------------------------- */

double FixRBCIB::memory_usage()
{
  return static_cast<double>(members.capacity() * sizeof(int) +
                             start_of_step.capacity() * sizeof(double));
}
