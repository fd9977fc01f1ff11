// The part of DrivenFlow that holds the mean velocity inside a vessel, and keeps what a flow
// without inertia remembers.

#include "coupling/rbc_driven_flow.h"
#include "domain.h"
#include "error.h"
#include "math_const.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

double DrivenFlow::probe_velocity() const
{
  constexpr double PROBE_COURANT = 0.02;    // cells per step
  return PROBE_COURANT * smallest_spacing() / (update->dt > 0 ? update->dt : 1);
}

/* ----------------------------------------------------------------------
   The control first probes the response with the body force that gives Poiseuille flow in a round
   tube of the vessel's mean cross-section. The probe is so weak that even where the vessel is
   narrow no atom crosses too many cells in a step.
------------------------------------------------------------------------- */

void DrivenFlow::start_control()
{
  const double section = inside_.volume(*flow_) / domain->prd[forcing_.held_direction()];
  const double velocity = probe_velocity();
  const bool by_mean = holds_box_mean();
  const double body = 8 * MathConst::MY_PI * settings_.equations.viscosity * velocity / section;
  forcing_.start_control(by_mean, by_mean ? velocity : body);
}

/* ----------------------------------------------------------------------
   The control goes on with the response that an earlier run or a restart file knows, if there is
   one.
------------------------------------------------------------------------- */

void DrivenFlow::continue_control()
{
  if (forcing_.knows_response(holds_box_mean()))
    forcing_.hold_measured(rate_inside());
  else
    start_control();
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::correct_flow_rate()
{
  if (controls_flow_rate()) forcing_.set_measured(rate_inside());
  if (ports_ && ports_->controls()) ports_->set_measured(port_pressures());
  set_time_now();
}

bool DrivenFlow::probe_flow_rate()
{
  if (ports_ && ports_->controls()) return probe_ports();
  if (!controls_flow_rate()) return false;
  if (forcing_.is_holding()) {
    if (!forcing_.agrees(rate_inside()))
      start_control();    // walls, cells or forcing are others
    else if (!forcing_.follow_wanted())
      return false;
    set_time_now();
    return true;
  }
  if (!forcing_.probing()) return false;
  if (forcing_.probes_response()) check_probe();
  correct_flow_rate();
  return true;
}

/* ----------------------------------------------------------------------
   A response that is measured while fluid passes the walls would drive any flow.
------------------------------------------------------------------------- */

void DrivenFlow::check_probe() const
{
  if (!walls_ || walls_->converged()) return;
  const WallGroup &wall = *walls_->first();
  error->all(FLERR,
             "{}: how its vessel responds to a flow cannot be measured, as {} reached its maxiter "
             "of {} with a slip of {:.3g}: increase maxiter or tol",
             style_, wall.style(), wall.settings().max_solves, walls_->slip());
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::hold_walls()
{
  if (walls_) walls_->hold(*flow_);
}

void DrivenFlow::release_walls(bool as_before)
{
  if (!walls_) return;
  if (as_before)
    walls_->restore();
  else
    walls_->release();
}

/* ---------------------------------------------------------------------- */

std::vector<double> DrivenFlow::memory(std::size_t most)
{
  FlowForcing::State control{};
  if (controls_flow_rate()) control = forcing_.control_state(rate_inside());
  std::vector<double> memory(control.begin(), control.end());
  if (!walls_) return memory;
  const std::vector<double> of_walls = walls_->memory(*flow_, most - memory.size());
  memory.insert(memory.end(), of_walls.begin(), of_walls.end());
  return memory;
}

void DrivenFlow::remember(std::vector<double> memory)
{
  FlowForcing::State control;
  std::copy_n(memory.begin(), control.size(), control.begin());
  forcing_.restore_control(control);
  memory.erase(memory.begin(), memory.begin() + control.size());
  wall_memory_ = std::move(memory);
}
