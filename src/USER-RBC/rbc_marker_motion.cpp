#include "rbc_marker_motion.h"

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "dihedral.h"
#include "domain.h"
#include "fix_rbc_fluid.h"
#include "fix_rbc_membrane.h"
#include "force.h"
#include "improper.h"
#include "kspace.h"
#include "modify.h"
#include "pair.h"
#include "pair_rbc_jkr.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using rbc::Numbers;

// linear solves, where the membranes' viscosity depends on the velocities

static constexpr int MOST_ROUNDS = 20;

/* ---------------------------------------------------------------------- */

MarkerMotion::MarkerMotion(LAMMPS *lmp, std::string style, int groupbit, fluid::KernelKind kernel) :
    Pointers(lmp), stop(std::make_shared<CollectiveStop>(lmp)), style_(std::move(style)),
    groupbit_(groupbit), kernel_(kernel)
{
}

void MarkerMotion::connect(FixRBCFluid *fluid, const std::vector<FixRBCMembrane *> &membranes)
{
  fluid_ = fluid;
  keepers_.clear();
  viscous_.clear();
  for (FixRBCMembrane *membrane : membranes) {
    if (membrane->keeps_volume()) keepers_.push_back(membrane);
    if (membrane->is_viscous()) viscous_.push_back(membrane);
    membrane->report_to(stop);
  }
  for (PairRBCJKR *pair : PairRBCJKR::all(force)) pair->report_to(stop);
}

void MarkerMotion::find_markers()
{
  members_.clear();
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit_) members_.push_back(i);
}

fluid::Markers MarkerMotion::markers() const
{
  return {static_cast<int>(members_.size()), members_.data()};
}

void MarkerMotion::reset_stopwatches()
{
  for (rbc::Stopwatch *watch : {&spreading, &solving, &interpolating, &exchanging}) watch->reset();
}

/* ---------------------------------------------------------------------- */

void MarkerMotion::load(double **array, Numbers &numbers, int column) const
{
  numbers.resize(3 * members_.size());
  for (std::size_t n = 0; n < members_.size(); ++n)
    for (int d = 0; d < 3; ++d) numbers[3 * n + d] = array[members_[n]][column + d];
}

void MarkerMotion::store(const Numbers &numbers, double **array, int column) const
{
  for (std::size_t n = 0; n < members_.size(); ++n)
    for (int d = 0; d < 3; ++d) array[members_[n]][column + d] = numbers[3 * n + d];
}

void MarkerMotion::sum(double *values, int count) const
{
  MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, world);
}

/* ---------------------------------------------------------------------- */

void MarkerMotion::spread_forces()
{
  fluid::Flow &flow = fluid_->flow();
  spreading.start();
  flow.clear_force();
  const int outside =
      flow.spread(kernel_, markers(), rows(atom->x), rows(atom->f), force->ftm2v, as);
  if (outside >= 0) report_outside(outside);
  spreading.stop();
  if (fluid_->rigid_walls() && !probing) fluid_->spread_walls(total_force(), *stop);
  stop->check();

  exchanging.start();
  flow.gather_force();
  exchanging.stop();
}

std::array<double, 3> MarkerMotion::total_force() const
{
  std::array<double, 3> sum{};
  for (int i : members_)
    for (int d = 0; d < 3; ++d) sum[d] += atom->f[i][d] * force->ftm2v;
  return sum;
}

/* ---------------------------------------------------------------------- */

void MarkerMotion::solve()
{
  solving.start();
  fluid_->flow().solve();
  solving.stop();
  if (!probing) fluid_->enforce_walls();
  fluid_->flow_changed();
}

/* ----------------------------------------------------------------------
   atoms take the velocity of the fluid
------------------------------------------------------------------------- */

void MarkerMotion::interpolate(Stage stage)
{
  fluid::Flow &flow = fluid_->flow();
  exchanging.start();
  flow.share_velocity();
  exchanging.stop();

  interpolating.start();
  flow.interpolate(kernel_, markers(), rows(atom->x), rows(atom->v), as);
  interpolating.stop();

  keep_volume(stage);
}

void MarkerMotion::keep_volume(Stage stage)
{
  for (FixRBCMembrane *membrane : keepers_)
    membrane->keep_volume(update->dt, stage == Stage::START, fluid_->has_inertia());
}

void MarkerMotion::velocities_of_forces(Stage stage)
{
  spread_forces();
  solve();
  interpolate(stage);
}

/* ----------------------------------------------------------------------
   with viscous membranes the forces were computed with the velocities v that atoms had; those sought obey
     (1 + M Z) V = M (F + Z v) + U,   Z the resistance of the membranes, M the mobility of the markers
   where Z depends on V, Newton's method: Z is that of small changes of V, and what is left goes into the next round. A
   round that gains little is followed by one with the viscosity frozen, which always gains (Kacanov's method).
------------------------------------------------------------------------- */

void MarkerMotion::update_velocities(Stage stage)
{
  if (viscous_.empty() || probing) {
    velocities_of_forces(stage);
    check_velocities(stage);
    return;
  }

  // walls are left out of the mobility of the markers: rounds follow here, too
  bool rounds = fluid_->rigid_walls() != nullptr;
  for (const FixRBCMembrane *membrane : viscous_) rounds = rounds || membrane->is_thinning();
  double count = static_cast<double>(members_.size());
  sum(&count, 1);

  load(atom->v, guess_);
  velocities_of_forces(stage);
  double error = 0;
  bool frozen = false;
  for (int round = 0;; ++round) {
    load(atom->f, forces_);
    find_residual();
    const double before = error, allowed = tolerance * fastest() * std::sqrt(count);
    error = std::sqrt(dot(*this, residual_, residual_));
    if (round > 0 && !(error > allowed)) break;
    if (round == MOST_ROUNDS) {
      ++unconverged;
      break;
    }
    frozen = round > 0 && !frozen && error > before / 2;

    store(guess_, atom->v);
    for (FixRBCMembrane *membrane : viscous_) membrane->linearise(frozen);
    correction_.assign(guess_.size(), 0.0);
    const double linear_error = gmres.solve(
        [this](const Numbers &p, Numbers &result) {
          resistance(p, result);
          for (std::size_t i = 0; i < p.size(); ++i) result[i] += p[i];
        },
        *this, residual_, rounds ? allowed / 2 : allowed, correction_);
    correct_forces();
    velocities_of_forces(stage);
    if (rounds) continue;
    if (!(linear_error <= allowed)) ++unconverged;
    break;
  }
  check_velocities(stage);
}

/* ---------------------------------------------------------------------- */

void MarkerMotion::find_residual()
{
  load(atom->v, residual_);
  for (std::size_t i = 0; i < guess_.size(); ++i) residual_[i] -= guess_[i];
}

/* ----------------------------------------------------------------------
   adds the correction to the velocities guessed, and what follows from it to the forces
------------------------------------------------------------------------- */

void MarkerMotion::correct_forces()
{
  store(forces_, atom->f);
  for (FixRBCMembrane *membrane : viscous_) {
    if (membrane->is_thinning()) {
      store(guess_, atom->v);
      membrane->add_viscous_forces(true, -1);
    }
  }
  for (std::size_t i = 0; i < guess_.size(); ++i) guess_[i] += correction_[i];
  for (FixRBCMembrane *membrane : viscous_) {
    store(membrane->is_thinning() ? guess_ : correction_, atom->v);
    membrane->add_viscous_forces(true);
  }
}

/* ---------------------------------------------------------------------- */

void MarkerMotion::velocity(const Numbers &x, double fraction, Numbers &v)
{
  store(x, atom->x);
  if (probing) std::fill(v.begin(), v.end(), 0.0);
  store(v, atom->v);
  check_positions();
  fluid_->drive_at(fraction);
  recompute_forces();
  update_velocities(Stage::MIDDLE);
  load(atom->v, v);
}

/* ----------------------------------------------------------------------
   M Z p: minus the velocities that the membranes' viscous forces cause if the atoms move with p
------------------------------------------------------------------------- */

void MarkerMotion::resistance(const Numbers &p, Numbers &v)
{
  v.assign(p.size(), 0.0);
  store(p, atom->v);
  store(v, atom->f);
  for (FixRBCMembrane *membrane : viscous_) membrane->add_viscous_change();

  const std::size_t all = 3 * static_cast<std::size_t>(atom->nlocal);
  applied_.resize(all);
  response_.resize(all);
  for (int i : members_)
    for (int d = 0; d < 3; ++d) applied_[3 * std::size_t(i) + d] = -atom->f[i][d] * force->ftm2v;
  solving.start();
  fluid_->flow().respond(kernel_, markers(), rows(atom->x), applied_.data(), response_.data(), as);
  solving.stop();
  for (std::size_t n = 0; n < members_.size(); ++n)
    for (int d = 0; d < 3; ++d) v[3 * n + d] = response_[3 * std::size_t(members_[n]) + d];
}

/* ---------------------------------------------------------------------- */

void MarkerMotion::recompute_forces()
{
  exchanging.start();
  comm->forward_comm();
  exchanging.stop();

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
   LAMMPS would delete what is beyond a plate when atoms migrate
------------------------------------------------------------------------- */

void MarkerMotion::check_positions()
{
  if (domain->zperiodic) return;
  double **const x = atom->x;
  for (int i : members_)
    if (!(x[i][2] >= domain->boxlo[2] && x[i][2] < domain->boxhi[2]))
      return report(i, "went through a plate");
}

/* ---------------------------------------------------------------------- */

double MarkerMotion::fastest() const
{
  double fastest2 = 0;
  for (int i : members_) {
    const double *const v = atom->v[i];
    fastest2 = std::max(fastest2, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  MPI_Allreduce(MPI_IN_PLACE, &fastest2, 1, MPI_DOUBLE, MPI_MAX, world);
  return std::sqrt(fastest2);
}

double MarkerMotion::longest_step() const
{
  return 0.5 * courant * fluid_->smallest_spacing() / fastest();
}

/* ---------------------------------------------------------------------- */

void MarkerMotion::check_velocities(Stage stage)
{
  report_too_fast(stage);
  stop->check();
}

void MarkerMotion::report_too_fast(Stage stage)
{
  const bool any_speed = probing || (timestep_follows && stage == Stage::START);
  const double fastest = courant * fluid_->smallest_spacing() / update->dt;
  double **const v = atom->v;
  for (int i : members_) {
    const double speed2 = v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2];
    if (std::isfinite(speed2) && (any_speed || speed2 <= fastest * fastest)) continue;
    if (std::isfinite(speed2))
      return report(i,
                    fmt::format("would cross {:.3g} fluid cells in a step (CFL above {}; timestep "
                                "too large or unstable)",
                                courant * std::sqrt(speed2) / fastest, courant));
    return report(i, "has a velocity that is not a number");
  }
}

void MarkerMotion::report_outside(int i)
{
  report(i, "left the fluid its MPI task holds (reneighboring too rare, see neigh_modify)");
}

void MarkerMotion::report(int i, const std::string &what)
{
  double **const x = atom->x;
  stop->report(fmt::format(
      "{}: vertex with atom ID {} {} at step {}: molecule ID {} at ({:.6g}, {:.6g}, {:.6g})",
      style_, atom->tag[i], what, update->ntimestep, atom->molecule_flag ? atom->molecule[i] : 0,
      x[i][0], x[i][1], x[i][2]));
}

/* ---------------------------------------------------------------------- */

std::size_t MarkerMotion::numbers() const
{
  std::size_t sum = gmres.numbers();
  for (const Numbers *vector : {&guess_, &forces_, &residual_, &correction_, &applied_, &response_})
    sum += vector->capacity();
  return sum;
}
