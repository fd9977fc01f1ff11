#include "comm.h"
#include "coupling/rbc_driven_flow.h"
#include "coupling/rbc_fluid_client.h"
#include "error.h"

#include <utility>

using namespace LAMMPS_NS;

// What a flow takes from its clients at the start of a run: demands, and walls.

/* ---------------------------------------------------------------------- */

void DrivenFlow::start_run(const std::vector<FluidClient *> &clients, const std::string &fluid_id)
{
  forcing_.check();
  inside_.forget();    // the region may be another one
  excess_ = {};
  take_demands(clients, fluid_id);
  if (layers_needed() != ghost_layers_) build();
  if (controls_flow_rate()) continue_control();
  if (ports_ && ports_->controls()) continue_port_control();
}

void DrivenFlow::take_demands(const std::vector<FluidClient *> &clients,
                              const std::string &fluid_id)
{
  driven_ = sheets_ = layers_ = false;
  std::vector<WallGroup *> groups;
  std::vector<Port *> ports;
  for (FluidClient *client : clients) {
    if (client->fluid_id() != fluid_id) continue;
    if (client->drives_flow()) {
      driven_ = true;
      cells_per_step_ = client->cells_per_step();
    }
    sheets_ = sheets_ || client->has_sheets();
    layers_ = layers_ || client->has_layers(settings_.equations.viscosity);
    if (client->wall_group()) groups.push_back(client->wall_group());
    if (client->port()) ports.push_back(client->port());
  }
  connect_ports(std::move(ports));
  connect_walls(groups);
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::connect_ports(std::vector<Port *> ports)
{
  if (ports.empty()) {
    flow_->end_supply();
    ports_.reset();
    return;
  }
  const std::string &style = ports.front()->style;
  if (has_inertia()) error->all(FLERR, "{} needs {} inertia none", style, inside_.style());
  if (controls_flow_rate())
    error->all(FLERR, "{} cannot be used with {} mean {} ...: the flows of ports drive the fluid",
               style, inside_.style(), "xyz"[forcing_.held_direction()]);
  if (!ports_) ports_ = std::make_unique<FlowPorts>(lmp);
  ports_->connect(std::move(ports));
}

/* ----------------------------------------------------------------------
   with walls the mean velocity of a triply periodic box follows from the balance of forces unless
   it is given
------------------------------------------------------------------------- */

void DrivenFlow::connect_walls(const std::vector<WallGroup *> &groups)
{
  free_mean_ = false;
  if (groups.empty()) {
    walls_.reset();
    if (!has_inertia() && settings_.free_mean)
      error->all(FLERR, "Fix rbc/fluid mean force needs inertia unsteady or convective, or a fix "
                        "rbc/wall: without them a net force has nothing to accelerate or to act "
                        "on");
    warn_of_idle_forcing();
    return;
  }
  if (has_inertia())
    error->all(FLERR, "{} needs {} inertia none", groups.front()->style(), inside_.style());
  free_mean_ = !settings_.plates && !settings_.prescribed_mean;
  if (!walls_) {
    walls_ = std::make_unique<RigidWalls>(lmp);
    walls_->remember(std::move(wall_memory_));
    wall_memory_ = {};
  }
  walls_->connect(groups, free_mean_);
  const WallGroup::Settings &wall = walls_->first()->settings();
  if (ports_) ports_->fit_to_wall(wall.kernel, wall.kind);
  warn_of_vessel_at_rest();
}

/* ----------------------------------------------------------------------
   a vessel whose author forgot what drives the flow
------------------------------------------------------------------------- */

void DrivenFlow::warn_of_vessel_at_rest() const
{
  if (settings_.inside.empty() || settings_.plates || settings_.prescribed_mean || comm->me != 0)
    return;
  if (controls_flow_rate() || walls_->moves() || ports_) return;
  for (const NumberOrVariable &component : forcing_.body)
    if (component.is_variable() || component.value(lmp) != 0) return;
  error->warning(FLERR, "{} inside {}: nothing drives the flow there; use mean or body", style_,
                 settings_.inside);
}

void DrivenFlow::warn_of_idle_forcing() const
{
  if (!holds_box_mean() || comm->me != 0) return;
  if (controls_flow_rate()) {
    if (!settings_.inside.empty())
      error->warning(FLERR,
                     "{} inside {}: there is no fix rbc/wall to keep the flow inside, that of the "
                     "whole box is held",
                     style_, settings_.inside);
    return;
  }
  for (const NumberOrVariable &component : forcing_.body)
    if (component.is_variable() || component.value(lmp) != 0) {
      error->warning(FLERR, "Fix rbc/fluid body has no effect in a triply periodic box whose "
                            "mean velocity is held: a pressure gradient balances it");
      break;
    }
}
