#include "coupling/rbc_flow_drive.h"

#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FlowDrive::FlowDrive(LAMMPS *lmp, std::string style) : Pointers(lmp), style_(std::move(style)) {}

/* ---------------------------------------------------------------------- */

void FlowDrive::hold_inside(int direction, const NumberOrVariable &velocity)
{
  held_direction_ = direction;
  held_velocity_ = velocity;
}

void FlowDrive::start_control(bool by_mean, double probe)
{
  by_mean_ = by_mean;
  is_measured_ = false;
  control_.probe(probe);
}

void FlowDrive::measured(double inside_velocity)
{
  measured_ = inside_velocity;
  is_measured_ = true;
}

void FlowDrive::control()
{
  const double wanted = held_velocity_.value(lmp);
  if (is_measured_) control_.adjust(measured_, wanted);
  is_measured_ = false;
  (by_mean_ ? end_.mean : end_.body)[held_direction_] = control_.input();
}

/* ---------------------------------------------------------------------- */

bool FlowDrive::varies() const
{
  if (held_direction_ >= 0) return true;
  for (const Vector *vector : {&lower, &upper, &body, &mean})
    for (const NumberOrVariable &component : *vector)
      if (component.is_variable()) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void FlowDrive::check() const
{
  for (const Vector *vector : {&lower, &upper, &body, &mean})
    for (const NumberOrVariable &component : *vector) component.check(lmp, "fix rbc/fluid");
  held_velocity_.check(lmp, "fix rbc/fluid");
}

/* ---------------------------------------------------------------------- */

const fluid::Drive &FlowDrive::evaluate()
{
  if (known_ && !varies()) return end_;
  known_ = true;
  modify->clearstep_compute();
  for (int d = 0; d < 3; ++d) {
    end_.walls.lower[d] = lower[d].value(lmp);
    end_.walls.upper[d] = upper[d].value(lmp);
    end_.body[d] = body[d].value(lmp) * force->ftm2v;
    end_.mean[d] = mean[d].value(lmp);
  }
  if (held_direction_ >= 0) control();
  modify->addstep_compute(update->ntimestep + 1);

  for (const auto *vector : {&end_.walls.lower, &end_.walls.upper, &end_.body, &end_.mean})
    for (double component : *vector)
      if (!std::isfinite(component))
        error->all(FLERR,
                   "{}: a plate velocity, body force or mean velocity is not a number at step {}",
                   style_, update->ntimestep);
  return end_;
}

/* ---------------------------------------------------------------------- */

void FlowDrive::begin_step(bool again)
{
  if (!again) start_ = end_;
  evaluate();
}

/* ---------------------------------------------------------------------- */

fluid::Drive FlowDrive::at(double fraction) const
{
  const auto mix = [fraction](double start, double end) {
    return start + fraction * (end - start);
  };
  fluid::Drive drive;
  for (int d = 0; d < 3; ++d) {
    drive.walls.lower[d] = mix(start_.walls.lower[d], end_.walls.lower[d]);
    drive.walls.upper[d] = mix(start_.walls.upper[d], end_.walls.upper[d]);
    drive.body[d] = mix(start_.body[d], end_.body[d]);
    drive.mean[d] = mix(start_.mean[d], end_.mean[d]);
  }
  return drive;
}
