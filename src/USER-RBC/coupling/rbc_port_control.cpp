// The part of DrivenFlow that holds the pressures in ports.

#include "coupling/rbc_driven_flow.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void DrivenFlow::start_port_control()
{
  ports_->start_control(probe_velocity(), *flow_, inside_);
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
    if (!ports_->agrees(port_pressures()))
      start_port_control();    // walls, cells or ports are others
    else if (!ports_->follow_wanted())
      return false;
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
