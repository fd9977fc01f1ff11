// The part of DrivenFlow that holds the pressures in ports.

#include "coupling/rbc_driven_flow.h"
#include "update.h"

using namespace LAMMPS_NS;

// cells per step, in a port, of the flow that probes how a vessel responds, as for flow rates

static constexpr double PROBE_COURANT = 0.02;

/* ---------------------------------------------------------------------- */

void DrivenFlow::start_port_control()
{
  const double dt = update->dt > 0 ? update->dt : 1;
  ports_->start_control(PROBE_COURANT * smallest_spacing() / dt, *flow_, inside_);
}

void DrivenFlow::continue_port_control()
{
  if (ports_->knows_response())
    ports_->hold_measured(port_pressures());
  else
    start_port_control();
}

/* ---------------------------------------------------------------------- */

bool DrivenFlow::probe_ports()
{
  if (ports_->is_holding()) {
    if (ports_->agrees(port_pressures())) return false;
    start_port_control();    // walls, cells or ports are others
    set_time_now();
    return true;
  }
  if (!ports_->probing()) return false;
  if (ports_->probes_response()) check_probe();
  correct_flow_rate();
  return true;
}

/* ---------------------------------------------------------------------- */

const std::vector<double> &DrivenFlow::port_pressures()
{
  finish_evaluation();
  return ports_->pressures(*flow_, inside_, version_);
}

double DrivenFlow::port_pressure(const Port *port)
{
  return ports_->pressure(port, port_pressures());
}

std::vector<double> DrivenFlow::port_memory()
{
  if (!ports_->controls()) return {};
  return ports_->control_state(port_pressures());
}
