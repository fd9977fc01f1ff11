#include "coupling/rbc_flow_forcing.h"

#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

// Solves of the same forces differ by less than this part of the velocity that the input causes:
// walls and viscous membranes are solved for within a tolerance.

static constexpr double SAME = 1.0e-3;

/* ---------------------------------------------------------------------- */

FlowForcing::FlowForcing(LAMMPS *lmp, std::string style) : Pointers(lmp), style_(std::move(style))
{
}

/* ---------------------------------------------------------------------- */

void FlowForcing::hold_inside(int direction, const NumberOrVariable &velocity)
{
  held_direction_ = direction;
  held_velocity_ = velocity;
}

void FlowForcing::start_control(bool by_mean, double probe)
{
  controlled_ = true;
  by_mean_ = by_mean;
  is_measured_ = holding_ = false;
  control_.probe(probe);
}

void FlowForcing::set_measured(double inside_velocity)
{
  if (!holding_) measured_ = inside_velocity;
  holding_ = false;
  is_measured_ = true;
}

void FlowForcing::hold_measured(double inside_velocity)
{
  if (!holding_) measured_ = inside_velocity;
  holding_ = true;
}

bool FlowForcing::agrees(double given) const
{
  return std::abs(given - measured_) <= SAME * std::abs(control_.effect());
}

bool FlowForcing::follow_wanted()
{
  if (wanted_ == *wanted_then_) return false;
  control_.shift(wanted_ - *wanted_then_);
  holding_ = false;
  return true;
}

FlowForcing::State FlowForcing::control_state(double inside_velocity) const
{
  const rbc::ResponseControl::State known = control_.state();
  return {double(knows_response(by_mean_)),
          double(held_direction_),
          double(by_mean_),
          known[0],
          known[1],
          known[2],
          holding_ ? measured_ : inside_velocity};
}

void FlowForcing::restore_control(const State &state)
{
  if (state[0] == 0 || state[1] != held_direction_) return;
  controlled_ = holding_ = true;
  by_mean_ = state[2] != 0;
  control_.restore({state[3], state[4], state[5]});
  measured_ = state[6];
}

void FlowForcing::control()
{
  wanted_ = held_velocity_.value(lmp);
  if (!holding_ || !wanted_then_) wanted_then_ = wanted_;    // a restart file does not have it
  const bool learns = is_measured_ && control_.probing();
  if (is_measured_) control_.adjust(measured_, wanted_);
  is_measured_ = false;
  if (learns && !control_.probing() && !control_.takes_work())
    error->all(FLERR,
               "{}: how the mean velocity responds to what drives it was lost in the slip of the "
               "walls, as it would set free work at step {}: use a smaller tol of fix rbc/wall",
               style_, update->ntimestep);
  (by_mean_ ? end_.mean : end_.body)[held_direction_] = control_.input();
}

/* ---------------------------------------------------------------------- */

bool FlowForcing::varies() const
{
  if (held_direction_ >= 0) return true;
  for (const Vector *vector : {&lower, &upper, &body, &mean})
    for (const NumberOrVariable &component : *vector)
      if (component.is_variable()) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void FlowForcing::check() const
{
  for (const Vector *vector : {&lower, &upper, &body, &mean})
    for (const NumberOrVariable &component : *vector) component.check(lmp, "fix rbc/fluid");
  held_velocity_.check(lmp, "fix rbc/fluid");
}

/* ---------------------------------------------------------------------- */

const fluid::Forcing &FlowForcing::evaluate()
{
  if (known_ && !varies()) return end_;
  known_ = true;
  modify->clearstep_compute();
  for (int d = 0; d < 3; ++d) {
    end_.plates.lower[d] = lower[d].value(lmp);
    end_.plates.upper[d] = upper[d].value(lmp);
    end_.body[d] = body[d].value(lmp) * force->ftm2v;
    end_.mean[d] = mean[d].value(lmp);
  }
  if (held_direction_ >= 0) control();
  modify->addstep_compute(update->ntimestep + 1);

  for (const auto *vector : {&end_.plates.lower, &end_.plates.upper, &end_.body, &end_.mean})
    for (double component : *vector)
      if (!std::isfinite(component))
        error->all(FLERR,
                   "{}: a plate velocity, body force or mean velocity is not a number at step {}",
                   style_, update->ntimestep);
  return end_;
}

/* ---------------------------------------------------------------------- */

void FlowForcing::begin_step(bool again)
{
  if (!again) start_ = end_;
  evaluate();
}

/* ---------------------------------------------------------------------- */

fluid::Forcing FlowForcing::at(double fraction) const
{
  const auto mix = [fraction](double start, double end) {
    return start + fraction * (end - start);
  };
  fluid::Forcing forcing;
  for (int d = 0; d < 3; ++d) {
    forcing.plates.lower[d] = mix(start_.plates.lower[d], end_.plates.lower[d]);
    forcing.plates.upper[d] = mix(start_.plates.upper[d], end_.plates.upper[d]);
    forcing.body[d] = mix(start_.body[d], end_.body[d]);
    forcing.mean[d] = mix(start_.mean[d], end_.mean[d]);
  }
  return forcing;
}
