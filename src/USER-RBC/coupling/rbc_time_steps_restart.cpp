// The part of TimeSteps that goes into restart files.

#include "coupling/rbc_time_steps.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

TimeSteps::State TimeSteps::state() const
{
  State state{last_dt_, next_dt_, static_cast<double>(velocity_step_)};
  const rbc::Integrator::State kept = integrator_->state();
  std::copy(kept.begin(), kept.end(), state.begin() + 3);
  return state;
}

void TimeSteps::restart(const double *state)
{
  last_dt_ = state[0];
  next_dt_ = state[1];
  velocity_step_ = static_cast<bigint>(state[2]);
  rbc::Integrator::State kept;
  std::copy_n(state + 3, kept.size(), kept.begin());
  integrator_->restore(kept);
  restarted_ = true;
}

void TimeSteps::restart_from_before(const double *state)
{
  State all{state[0], state[1], -1};
  std::copy_n(state + 2, 3, all.begin() + 3);
  restart(all.data());
}
