#include "coupling/rbc_time_steps.h"

#include "atom.h"
#include "cells/rbc_cell_contact.h"
#include "cells/rbc_cell_crossings.h"
#include "cells/rbc_cell_membranes.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;
using rbc::Numbers;

// smallest timestep over the largest

static constexpr double SMALLEST_PART = 1.0e-6;

static constexpr double SAME = 1.0e-6;    // difference of velocities, relative to them

/* ---------------------------------------------------------------------- */

TimeSteps::TimeSteps(LAMMPS *lmp, std::string style, ImmersedMarkers &markers,
                     std::unique_ptr<rbc::Integrator> integrator, double tolerance,
                     double largest_dt) :
    Pointers(lmp),
    style_(std::move(style)), markers_(markers), store_(markers)
{
  control_.tolerance = tolerance;
  control_.largest = largest_dt;
  control_.smallest = SMALLEST_PART * largest_dt;
  set_integrator(std::move(integrator));
}

void TimeSteps::set_integrator(std::unique_ptr<rbc::Integrator> integrator)
{
  integrator_ = std::move(integrator);
  control_.order = integrator_->order();
  control_.growth = integrator_->largest_growth();
}

double TimeSteps::update_dt() const
{
  return update->dt;
}

bigint TimeSteps::step() const
{
  return update->ntimestep;
}

/* ---------------------------------------------------------------------- */

void TimeSteps::start_run(DrivenFlow *flow, bool forces_change)
{
  flow_ = flow;
  forces_change_ = forces_change;
  const std::string before = std::exchange(acting_, what_acts());
  forces_differ_ = !before.empty() && acting_ != before;
  first_step_ = step();
  rejected_ = failed_ = 0;
  last_failure_.clear();
  markers_.allow_any_speed_between_steps(control_.active() || integrator_->can_retake());
  if (!control_.active()) return;
  const bool changed = update->dt != last_dt_ && !restarted_;    // by the user
  if (next_dt_ == 0 || changed) next_dt_ = update->dt;
  next_dt_ = std::min(next_dt_, control_.largest);
}

/* ----------------------------------------------------------------------
   Returns the names of all that may exert forces, and how stiff membranes are. Pair coefficients
   are left out.
------------------------------------------------------------------------- */

std::string TimeSteps::what_acts() const
{
  std::string names;
  for (const char *style : {force->pair_style, force->bond_style, force->angle_style,
                            force->dihedral_style, force->improper_style})
    if (style) names += std::string(style) + ' ';
  for (Fix *fix : modify->get_fix_list())
    if (modify->get_fix_mask(fix) & (FixConst::PRE_FORCE | FixConst::POST_FORCE))
      names += fmt::format("{} {} ", fix->id, fix->style);
  for (const CellMembranes *cells : all_cell_membranes(lmp))
    names += fmt::format("{} {} {} {} {} ", cells->shear_modulus(), cells->parameters().bending,
                         cells->parameters().local_area, cells->is_smoothed(),
                         cells->interior_viscosity());
  return names;
}

void TimeSteps::atoms_migrated()
{
  integrator_->points_migrated(markers_, markers_.members().size(), store_);
}

/* ----------------------------------------------------------------------
   Each style knows which surfaces it lets touch, and tests those that none before it does.
------------------------------------------------------------------------- */

void TimeSteps::find_crossings()
{
  crossings_.clear();
  std::vector<const CellContact *> before;
  for (CellContact *contact : find_cell_contacts(force)) {
    CellCrossings *const crossings = contact->crossings();
    if (!crossings) continue;
    if (crossings->start_run(*contact, before)) crossings_.push_back(crossings);
    before.push_back(contact);
  }
}

void TimeSteps::report_crossings()
{
  for (CellCrossings *crossings : crossings_) crossings->report(*markers_.stop());
}

/* ----------------------------------------------------------------------
   With inertia the atoms already hold the velocities that the first step starts from, those of the
   middle of the last step: they are only checked.
------------------------------------------------------------------------- */

void TimeSteps::setup()
{
  using Stage = ImmersedMarkers::Stage;
  find_crossings();
  if (flow_->has_inertia()) {
    markers_.check_velocities(Stage::start);
    return;
  }
  start_velocities();
  markers_.between_steps(true);
  if (forces_change_ && doubts_velocities_ && !flow_->is_probing_flow_rate()) {
    show_velocities();
    return;
  }
  markers_.velocities_from_forces(Stage::start);
  while (flow_->probe_flow_rate()) {
    markers_.recompute_forces();
    markers_.velocities_from_forces(Stage::start);
  }
  if (forces_change_)
    flow_->finish_evaluation();
  else
    compare_velocities();
  velocity_step_ = step();
  markers_.between_steps(true);
}

/* ----------------------------------------------------------------------
   An evaluation of the same forces differs from the one that ended the last step, by round-off or,
   with walls and viscosity, within a tolerance. Where it does not differ by more the old velocities
   stay, and all that the evaluation has changed is as before: a run in pieces, or continued from a
   restart file, is that of one piece. With adapt the timestep is that of the last step until the
   next one chooses its own.
------------------------------------------------------------------------- */

void TimeSteps::start_velocities()
{
  restarted_ = false;
  if (control_.active() && last_dt_ > 0) set_timestep(last_dt_, step());
  doubts_velocities_ = velocity_step_ == step();
  if (!doubts_velocities_) return;
  markers_.load(atom->v, V_);
  flow_->hold_walls();
}

/* ----------------------------------------------------------------------
   Forces of fixes that come later are missing still, so the first step compares velocities. Here
   they are evaluated for what is printed of the flow, and all stays as it was.
------------------------------------------------------------------------- */

void TimeSteps::show_velocities()
{
  rbc::Numbers &forces = integrator_->work()[0];
  markers_.load(atom->f, forces);
  markers_.velocities_from_forces(ImmersedMarkers::Stage::start);
  flow_->finish_evaluation();
  markers_.store(V_, atom->v);
  markers_.store(forces, atom->f);
  flow_->release_walls(true);
  flow_->hold_walls();
}

void TimeSteps::compare_velocities()
{
  const bool same = doubts_velocities_ && are_velocities_same();
  doubts_velocities_ = false;
  if (same) markers_.store(V_, atom->v);
  flow_->release_walls(same);
  integrator_->start_run(flow_->smallest_spacing(), same, forces_differ_);
}

bool TimeSteps::are_velocities_same()
{
  const double fastest = markers_.fastest();
  rbc::Numbers &change = integrator_->work()[0];
  markers_.load(atom->v, change);
  for (std::size_t i = 0; i < V_.size(); ++i) change[i] -= V_[i];
  return root_mean_square(markers_, change) <=
         std::max(SAME * root_mean_square(markers_, V_),
                  2 * markers_.implicit().tolerance() * fastest);
}

/* ---------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   A run that starts where neighbors were found, from a restart file too, knows no directions. So
   none is known in the step after these were found in the middle of a run.
------------------------------------------------------------------------- */

void TimeSteps::advance()
{
  choose_timestep();
  if (neighbor->ago == 0) markers_.implicit().forget_directions();
  markers_.load(atom->x, X_);
  markers_.load(atom->v, V_);
  for (CellCrossings *crossings : crossings_) crossings->start_step();
  tries_ = 0;
  seen_.clear();
  do {
    flow_->begin_step(tries_++ > 0);
    markers_.between_steps(false);
  } while (!step_is_accepted());
  flow_->place_walls(1);
  integrator_->accept(store_, start(), X_new_);
  last_dt_ = update->dt;
}

void TimeSteps::finish()
{
  if (!flow_->has_inertia()) {
    flow_->set_time_now();
    if (std::exchange(velocities_known_, false)) {
      markers_.constrain_volume(ImmersedMarkers::Stage::start);
    } else
      markers_.velocities_from_forces(ImmersedMarkers::Stage::start);
  }
  velocity_step_ = step();
  markers_.stop()->check();
  markers_.between_steps(true);
}

/* ---------------------------------------------------------------------- */

void TimeSteps::choose_timestep()
{
  if (flow_->has_inertia()) return;
  // These velocities are those of the last step's timestep, whatever the next one will be.
  if (forces_change_ && step() == first_step_ + 1) {
    markers_.velocities_from_forces(ImmersedMarkers::Stage::start);
    compare_velocities();
  }
  if (control_.active()) set_timestep(std::min(next_dt_, markers_.longest_step()), step() - 1);
}

void TimeSteps::take_step()
{
  markers_.forget_velocities();
  integrator_->step(markers_, store_, start(), X_new_);
}

/* ----------------------------------------------------------------------
   Makes the step and returns whether it counts: whether it has a result, and an error within the
   bound. Chooses the timestep of the next step, or of this one when it is made again.
------------------------------------------------------------------------- */

bool TimeSteps::step_is_accepted()
{
  if (!control_.active() && !integrator_->can_retake()) {
    take_step();
    check_result();
    return true;
  }

  const bool went_well = try_step();
  if (went_well && (!control_.active() || local_error_ <= control_.tolerance)) return true;
  integrator_->reject(markers_, store_, start(), X_new_);

  ++rejected_;
  if (!went_well) ++failed_;
  if (!went_well && seen_.back() == Flaw::crossed) crossings_.front()->count_retaken();
  if (control_.active()) {
    if (next_dt_ < control_.smallest) stop_adapting(!went_well);
    set_timestep(next_dt_, step() - 1);
  } else if (!integrator_->retake()) {
    stop_retaking();
  }
  return false;
}

/// Errors end a trial, not the run, while it lives.
struct Trying {
  bool &on;
  explicit Trying(bool &flag) : on(flag) { on = true; }
  ~Trying() { on = false; }
};

/* ----------------------------------------------------------------------
   Makes a step that may be taken again; returns false if something went wrong.
------------------------------------------------------------------------- */

bool TimeSteps::try_step()
{
  const std::size_t before = seen_.size();
  X_new_ = X_;
  velocities_known_ = false;
  try {
    const Trying trying(markers_.stop()->trying);
    take_step();
    if (control_.active()) {
      measure_error();
      next_dt_ = control_.next(update->dt, local_error_);
    } else
      check_result();
  } catch (const rbc::StepFailure &failure) {
    const std::string what = fmt::format("{}: {} at step {}", style_, failure.what(), step());
    if (!control_.active()) {
      seen_.push_back(Flaw::too_fast);
      markers_.stop()->end_run(tries_ == 1 ? what : last_failure_ + "; then " + what, seen_);
    }
    note_failure(what, Flaw::other);
  } catch (const CollectiveStop::FailedTrial &failure) {
    note_failure(failure.what(), failure.flaw);
  }
  if (seen_.size() == before) return true;
  if (control_.active()) next_dt_ = control_.after_failure(update->dt);
  return false;
}

void TimeSteps::note_failure(const std::string &what, Flaw flaw)
{
  last_failure_ = what;
  seen_.push_back(flaw);
}

/* ----------------------------------------------------------------------
   Checks the positions at the end of the step. LAMMPS computes the forces there, too late to take
   the step again. So they are computed here as well where something is likely to be wrong. With
   two stages the last evaluation is at a quarter of the step, and what comes later is unchecked.
------------------------------------------------------------------------- */

void TimeSteps::check_result()
{
  markers_.store(X_new_, atom->x);
  markers_.check_positions();
  if (tries_ > 1) markers_.check_displacements(X_, X_new_);    // parts allow more
  report_crossings();
  markers_.stop()->check();
  if (!integrator_->can_retake()) return;
  if (integrator_->has_grown())
    return note_failure(
        fmt::format("{}: displacements grew as in an unstable step at step {}", style_, step()),
        Flaw::unstable);
  if (tries_ == 1 && !integrator_->was_sudden() && !markers_.is_nearly_folded()) return;
  rbc::Numbers &V_new = integrator_->work()[0] = V_;
  markers_.guess_velocities(V_new);
  markers_.velocity_at_end(X_new_, V_new);
  velocities_known_ = true;
}

void TimeSteps::measure_error()
{
  markers_.store(X_new_, atom->x);
  report_crossings();
  rbc::Numbers &V_new = integrator_->work()[0] = V_;
  markers_.guess_velocities(V_new);
  markers_.velocity(X_new_, 1.0, V_new);
  velocities_known_ = true;
  local_error_ = rbc::StepControl::error(markers_, update->dt, X_, X_new_, V_, V_new);
}

/* ---------------------------------------------------------------------- */

void TimeSteps::stop_adapting(bool went_wrong)
{
  if (went_wrong)
    markers_.stop()->end_run(fmt::format("{} (so with all timesteps of adapt, down to {:.3g})",
                                         last_failure_, update->dt),
                             seen_);
  error->all(FLERR,
             "{}: no timestep above {:.3g} meets the error {:.3g} of adapt at step {}; the local "
             "error is {:.3g}",
             style_, control_.smallest, control_.tolerance, update->ntimestep, local_error_);
}

void TimeSteps::stop_retaking()
{
  markers_.stop()->end_run(
      fmt::format("{} (so also when the step was taken again, {} times, with more stages and in "
                  "parts)",
                  last_failure_, tries_ - 1),
      seen_);
}

/* ----------------------------------------------------------------------
   Changes LAMMPS's timestep from step `from_step` on: keeps the elapsed time right and tells pair
   styles, fixes and output. LAMMPS's fix dt/reset does the same.
------------------------------------------------------------------------- */

void TimeSteps::set_timestep(double dt, bigint from_step)
{
  if (dt == update->dt) return;
  update->atime += (from_step - update->atimestep) * update->dt;
  update->atimestep = from_step;
  update->dt = dt;
  update->dt_default = 0;
  if (force->pair) force->pair->reset_dt();
  const std::vector<Fix *> fixes = modify->get_fix_list();    // which others ask for, too
  for (Fix *fix : fixes) fix->reset_dt();

  // output by time is planned anew as at the end of the step before
  const bigint step = update->ntimestep;
  update->ntimestep = from_step;
  output->reset_dt();
  update->ntimestep = step;
}

/* ---------------------------------------------------------------------- */

std::size_t TimeSteps::bytes() const
{
  std::size_t numbers = 0;
  for (const Numbers *vector : {&X_, &V_, &X_new_}) numbers += vector->capacity();
  return integrator_->bytes() + numbers * sizeof(double);
}
