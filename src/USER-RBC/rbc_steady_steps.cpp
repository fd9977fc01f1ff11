#include "rbc_steady_steps.h"

#include "atom.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "fix_store_atom.h"
#include "force.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using rbc::Numbers;

// Steps between estimates of the spectral radius: the interval is halved where the radius changes by more than the
// larger of two parts from one to the next, doubled where it changes by less than the smaller. Its safety factor, and
// how far points are displaced for it, over the spacing of the fluid.

static constexpr int SHORTEST_INTERVAL = 5, LONGEST_INTERVAL = 50;
static constexpr double STEADY_CHANGE = 0.01, FAST_CHANGE = 0.03;
static constexpr double RADIUS_SAFETY = 1.06, LARGEST_RADIUS_GROWTH = 1.5;
static constexpr double RADIUS_DISPLACEMENT = 1.0e-5;
static constexpr int GUESS_ITERATIONS = 20;      // without a mode of an earlier estimate
static constexpr int SUSPECT_ITERATIONS = 10;    // after a step that was refused

// third order: largest ratio of a timestep to the one before, parts of a step without a past

static constexpr double LARGEST_GROWTH = 1.2;
static constexpr int STARTING_PARTS = 8;

// smallest timestep over the largest

static constexpr double SMALLEST_PART = 1.0e-6;

/* ---------------------------------------------------------------------- */

SteadySteps::SteadySteps(LAMMPS *lmp, std::string style, MarkerMotion &motion) :
    Pointers(lmp), style_(std::move(style)), motion_(motion)
{
}

void SteadySteps::choose(Method method, int stages, int order, double tolerance, double largest_dt)
{
  method_ = method;
  chebyshev_ = rbc::ChebyshevMethod(order);
  automatic_stages_ = method == Method::RKC && stages == 0;
  if (stages > 0) chebyshev_.set_stages(stages);
  control_.tolerance = tolerance;
  control_.largest = largest_dt;
  control_.smallest = SMALLEST_PART * largest_dt;
  control_.order = method == Method::EULER ? 1 : 2;
  if (chebyshev_.past_steps() > 0) control_.growth = LARGEST_GROWTH;
  motion_.timestep_follows = control_.active();
}

int SteadySteps::numbers_per_atom() const
{
  if (method_ == Method::AB2) return PAST + 3;
  return mode_column() + (automatic_stages_ ? 3 : 0);
}

/* ---------------------------------------------------------------------- */

void SteadySteps::start_run(FixRBCFluid *fluid, bool forces_change)
{
  fluid_ = fluid;
  forces_change_ = forces_change;
  first_step_ = update->ntimestep;
  radius_step_ = -1;
  radius_interval_ = SHORTEST_INTERVAL;
  raw_radius_ = 0;
  estimated_step_ = -1;
  rejected_ = failed_ = 0;
  suspected_ = false;
  if (!control_.active()) return;
  const bool changed = update->dt != last_dt_ && !restarted_;    // by the user
  if (next_dt_ == 0 || changed) next_dt_ = update->dt;
  next_dt_ = std::min(next_dt_, control_.largest);
  restarted_ = false;
}

void SteadySteps::atoms_migrated()
{
  if (chebyshev_.past_steps() == 0) return;
  known_steps_ = chebyshev_.past_steps();
  for (int i : motion_.members())
    known_steps_ = std::min(known_steps_, static_cast<int>(store_->astore[i][KNOWN]));
  MPI_Allreduce(MPI_IN_PLACE, &known_steps_, 1, MPI_INT, MPI_MIN, world);
}

/* ---------------------------------------------------------------------- */

void SteadySteps::advance()
{
  if (control_.active()) set_timestep(next_dt_, update->ntimestep - 1);
  if (forces_change_ && update->ntimestep == first_step_ + 1)
    motion_.update_velocities(MarkerMotion::Stage::START);
  if (control_.active())
    set_timestep(std::min(next_dt_, motion_.longest_step()), update->ntimestep - 1);

  motion_.load(atom->x, start_);
  motion_.load(atom->v, velocity_);
  bool again = false;
  do {
    fluid_->begin_step(again);
    again = true;
  } while (!attempt());
  motion_.store(position_, atom->x);
  fluid_->place_walls(1);
  motion_.check_positions();
  motion_.stop->check();
  remember();
  last_dt_ = update->dt;
}

void SteadySteps::finish()
{
  fluid_->drive_now();
  if (velocities_known_)
    motion_.keep_volume(MarkerMotion::Stage::START);
  else
    motion_.update_velocities(MarkerMotion::Stage::START);
  velocities_known_ = false;
}

/* ----------------------------------------------------------------------
   positions at the end of the step from those and the velocities at its start
------------------------------------------------------------------------- */

void SteadySteps::move()
{
  const double dt = update->dt;
  const auto along = [this](const Numbers &by, double span) {
    position_.resize(start_.size());
    for (std::size_t i = 0; i < start_.size(); ++i) position_[i] = start_[i] + span * by[i];
  };
  switch (method_) {
    case Method::EULER:
      along(velocity_, dt);
      break;
    case Method::MIDPOINT:
      along(velocity_, 0.5 * dt);
      middle_ = velocity_;
      motion_.velocity(position_, 0.5, middle_);
      along(middle_, dt);
      break;
    case Method::AB2:
      move_ab2();
      break;
    case Method::RKC:
      move_chebyshev();
      break;
  }
}

/* ----------------------------------------------------------------------
   an atom without a past takes an Euler step
------------------------------------------------------------------------- */

void SteadySteps::move_ab2()
{
  const double dt = update->dt, half_ratio = last_dt_ > 0 ? 0.5 * dt / last_dt_ : 0;
  position_.resize(start_.size());
  const std::vector<int> &members = motion_.members();
  for (std::size_t n = 0; n < members.size(); ++n) {
    const double *const past = store_->astore[members[n]];
    const double weight = past[KNOWN] > 0 ? half_ratio : 0;
    for (int d = 0; d < 3; ++d) {
      const double now = velocity_[3 * n + d];
      position_[3 * n + d] = start_[3 * n + d] + dt * (now + weight * (now - past[PAST + d]));
    }
  }
}

/* ---------------------------------------------------------------------- */

void SteadySteps::move_chebyshev()
{
  if (automatic_stages_ &&
      (radius_step_ < 0 || update->ntimestep >= radius_step_ + radius_interval_))
    estimate_radius();

  const int past_steps = chebyshev_.past_steps();
  path_.clear(past_steps);
  const int known = update->dt > LARGEST_GROWTH * past_dt_[0] ? 0 : known_steps_;
  for (int n = known - 1; n >= 0; --n) {
    motion_.load(store_->astore, scratch_, PAST + 3 * n);
    path_.add(past_dt_[n], scratch_);
  }
  if (known < past_steps) {
    start_chebyshev();
    return;
  }
  choose_stages(update->dt);
  chebyshev_.step(motion_, update->dt, start_, velocity_, path_, position_);
}

/* ----------------------------------------------------------------------
   third order: without a past the step is divided, so that it is as accurate as those that follow
------------------------------------------------------------------------- */

void SteadySteps::start_chebyshev()
{
  constexpr double part = 1.0 / STARTING_PARTS;
  const double dt = part * update->dt;
  const rbc::Path none;
  choose_stages(dt);
  position_ = start_;
  middle_ = velocity_;
  for (int n = 0; n < STARTING_PARTS; ++n) {
    if (n > 0) motion_.velocity(position_, n * part, middle_);
    scratch_ = position_;
    chebyshev_.step(motion_, dt, scratch_, middle_, none, position_, n * part, part);
  }
}

/* ---------------------------------------------------------------------- */

void SteadySteps::estimate_radius()
{
  motion_.load(store_->astore, middle_, mode_column());
  const bool known = dot(motion_, middle_, middle_) > 0;
  spectrum_.min_iterations = !known ? GUESS_ITERATIONS : suspected_ ? SUSPECT_ITERATIONS : 1;
  suspected_ = false;
  if (!known) {
    // a guess without any symmetry
    const std::vector<int> &members = motion_.members();
    for (std::size_t i = 0; i < middle_.size(); ++i)
      middle_[i] = std::sin(1.0 + 12.9898 * static_cast<double>(i % 3) +
                            78.233 * static_cast<double>(atom->tag[members[i / 3]]));
  }
  radius_ = 0;
  radius_step_ = update->ntimestep;
  if (root_mean_square(motion_, middle_) == 0) return;    // the group is empty
  const double size = RADIUS_DISPLACEMENT * fluid_->smallest_spacing();

  // the velocities known are those of other times, and of viscous forces, which are not solved for as exactly as
  // differences ask and only slow what relaxes
  motion_.probing = true;
  scratch_ = velocity_;
  motion_.velocity(start_, 0, scratch_);
  const double last =
      std::exchange(raw_radius_, spectrum_.estimate(motion_, start_, scratch_, size, middle_));
  foresee_radius(last);
  motion_.probing = false;
  if (!std::isfinite(radius_))
    error->all(FLERR, "{}: the spectral radius is not a number at step {}", style_,
               update->ntimestep);
  motion_.store(middle_, store_->astore, mode_column());
}

/* ----------------------------------------------------------------------
   what grows is taken to grow on until the next estimate
------------------------------------------------------------------------- */

void SteadySteps::foresee_radius(double last)
{
  radius_ = RADIUS_SAFETY * raw_radius_;
  const bool anew = std::exchange(estimated_step_, update->ntimestep) == update->ntimestep;
  if (anew || !(last > 0))
    return;    // of a step tried again, or the first: nothing to compare with
  const double ratio = raw_radius_ / last, change = std::abs(ratio - 1);
  if (change > FAST_CHANGE)
    radius_interval_ = std::max(radius_interval_ / 2, SHORTEST_INTERVAL);
  else if (change < STEADY_CHANGE)
    radius_interval_ = std::min(2 * radius_interval_, LONGEST_INTERVAL);
  radius_ *= std::clamp(ratio, 1.0, LARGEST_RADIUS_GROWTH);
}

void SteadySteps::choose_stages(double dt)
{
  if (!automatic_stages_) return;
  const int stages = chebyshev_.stages_for(dt * radius_);
  if (stages > rbc::ChebyshevMethod::MOST_STAGES) {
    motion_.stop->report(fmt::format(
        "{}: integrator rkc needs more than {} stages at step {}: the timestep {:.3g} is {:.3g} "
        "times the time in which the fastest mode relaxes",
        style_, rbc::ChebyshevMethod::MOST_STAGES, update->ntimestep, dt, dt * radius_));
    motion_.stop->check();
  }
  chebyshev_.set_stages(stages);
}

/* ----------------------------------------------------------------------
   what the next steps need to know of this one
------------------------------------------------------------------------- */

void SteadySteps::remember()
{
  const std::vector<int> &members = motion_.members();
  if (method_ == Method::AB2) {
    motion_.store(velocity_, store_->astore, PAST);
    for (int i : members) store_->astore[i][KNOWN] = 1;
    return;
  }
  const int past_steps = chebyshev_.past_steps();
  if (past_steps == 0) return;
  known_steps_ = std::min(path_.steps() + 1, past_steps);
  std::rotate(past_dt_.begin(), past_dt_.end() - 1, past_dt_.end());
  past_dt_[0] = update->dt;
  for (std::size_t n = 0; n < members.size(); ++n) {
    double *const past = store_->astore[members[n]];
    std::copy_backward(past + PAST, past + PAST + 3 * (past_steps - 1),
                       past + PAST + 3 * past_steps);
    for (int d = 0; d < 3; ++d) past[PAST + d] = position_[3 * n + d] - start_[3 * n + d];
    past[KNOWN] = known_steps_;
  }
}

/* ----------------------------------------------------------------------
   whether a step has a result with an error within its bound; the timestep of the next one, or of this one again
------------------------------------------------------------------------- */

bool SteadySteps::attempt()
{
  if (!control_.active()) {
    move();
    return true;
  }

  std::string flaw;
  position_ = start_;
  motion_.stop->trying = true;
  try {
    move();
    measure_error();
    next_dt_ = control_.next(update->dt, local_error_);
  } catch (const CollectiveStop::FailedTrial &failed) {
    flaw = failed.message;
    next_dt_ = control_.after_failure(update->dt);
    motion_.probing = false;
  }
  motion_.stop->trying = false;
  if (flaw.empty() && local_error_ <= control_.tolerance) return true;
  if (automatic_stages_) {
    motion_.load(store_->astore, middle_, mode_column());
    spectrum_.suspect(motion_, start_, position_, velocity_, middle_);
    motion_.store(middle_, store_->astore, mode_column());
    suspected_ = true;
  }

  ++rejected_;
  if (!flaw.empty()) {
    ++failed_;
    last_failure_ = flaw;
  }
  radius_step_ = -1;    // modes may have become faster, in contact for example
  if (next_dt_ < control_.smallest) stop_adapting(flaw);
  set_timestep(next_dt_, update->ntimestep - 1);
  return false;
}

void SteadySteps::measure_error()
{
  middle_ = velocity_;
  motion_.velocity(position_, 1.0, middle_);
  velocities_known_ = true;
  local_error_ =
      rbc::StepControl::error(motion_, update->dt, start_, position_, velocity_, middle_, scratch_);
}

void SteadySteps::stop_adapting(const std::string &flaw)
{
  if (!flaw.empty())
    error->all(FLERR, "{} (so with all timesteps of adapt, down to {:.3g})", flaw, update->dt);
  error->all(FLERR,
             "{}: no timestep above {:.3g} meets the error {:.3g} of adapt at step {}; the local "
             "error is {:.3g}",
             style_, control_.smallest, control_.tolerance, update->ntimestep, local_error_);
}

/* ----------------------------------------------------------------------
   as fix dt/reset does
------------------------------------------------------------------------- */

void SteadySteps::set_timestep(double dt, bigint from_step)
{
  if (dt == update->dt) return;
  update->atime += (from_step - update->atimestep) * update->dt;
  update->atimestep = from_step;
  update->dt = dt;
  update->dt_default = 0;
  if (force->pair) force->pair->reset_dt();
  for (Fix *fix : modify->get_fix_list()) fix->reset_dt();

  // output by time is planned anew as at the end of the step before
  const bigint step = update->ntimestep;
  update->ntimestep = from_step;
  output->reset_dt();
  update->ntimestep = step;
}

/* ---------------------------------------------------------------------- */

SteadySteps::State SteadySteps::state() const
{
  State state{last_dt_, next_dt_};
  std::copy(past_dt_.begin(), past_dt_.end(), state.begin() + 2);
  return state;
}

void SteadySteps::restart(const double *state)
{
  last_dt_ = state[0];
  next_dt_ = state[1];
  std::copy_n(state + 2, past_dt_.size(), past_dt_.begin());
  restarted_ = true;
}

std::size_t SteadySteps::numbers() const
{
  std::size_t sum = chebyshev_.numbers() + path_.numbers();
  for (const Numbers *vector : {&start_, &velocity_, &middle_, &position_, &scratch_})
    sum += vector->capacity();
  return sum;
}
