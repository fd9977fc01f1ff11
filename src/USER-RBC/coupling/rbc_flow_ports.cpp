#include "coupling/rbc_flow_ports.h"

#include "cells/rbc_region_enclosure.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

using namespace LAMMPS_NS;

// what rates may sum to, relative to the largest

static constexpr double SAME = 1.0e-9;

// Where flow grows along a wall, and so does the flow in the layer that the kernel blurs, half of
// what the layer takes must be supplied beyond the wall: otherwise fluid passes the wall. With this
// spread none does, but for 1e-3 of the flow where a tube is 14 cells wide (see bench/ports.sh).

static double spread_of(fluid::KernelKind kernel)
{
  return kernel == fluid::KernelKind::peskin4 ? 0.36 : 0;
}

/* ---------------------------------------------------------------------- */

void FlowPorts::connect(std::vector<const Port *> ports)
{
  const Port *rest = nullptr;
  for (const Port *port : ports) {
    port->rate.check(lmp, "fix rbc/port");
    if (port->has_rate) continue;
    if (rest)
      error->all(FLERR, "{} and {} have no flow: only one port may be without, it takes the rest",
                 rest->style, port->style);
    rest = port;
  }
  if (ports != ports_) end_.assign(ports.size(), 0.0);
  ports_ = std::move(ports);
  forget();
  supplied_.resize(ports_.size());
  measured_ = -1;
}

bool FlowPorts::varies() const
{
  return std::any_of(ports_.begin(), ports_.end(),
                     [](const Port *port) { return port->rate.is_variable(); });
}

/* ---------------------------------------------------------------------- */

void FlowPorts::evaluate()
{
  modify->clearstep_compute();
  for (std::size_t n = 0; n < ports_.size(); ++n) {
    end_[n] = ports_[n]->rate.value(lmp);
    if (!std::isfinite(end_[n]))
      error->all(FLERR, "{}: its flow is not a number at step {}", ports_[n]->style,
                 update->ntimestep);
  }
  modify->addstep_compute(update->ntimestep + 1);

  const auto rest =
      std::find_if(ports_.begin(), ports_.end(), [](const Port *port) { return !port->has_rate; });
  if (rest == ports_.end()) check_rates();
  const auto takes = rest == ports_.end() ? end_.end() - 1 : end_.begin() + (rest - ports_.begin());
  *takes -= std::accumulate(end_.begin(), end_.end(), 0.0);
  now_ = end_;
}

void FlowPorts::check_rates() const
{
  double largest = 0;
  for (double rate : end_) largest = std::max(largest, std::abs(rate));
  const double sum = std::accumulate(end_.begin(), end_.end(), 0.0);
  if (std::abs(sum) <= SAME * largest) return;
  std::string list;
  for (const Port *port : ports_) list += (list.empty() ? "f" : ", f") + port->style.substr(1);
  error->all(FLERR,
             "The flows of {} sum to {:.6g} at step {}, but must sum to 0: leave out the flow of "
             "one port, which then takes the rest",
             list, sum, update->ntimestep);
}

void FlowPorts::begin_step(bool again)
{
  if (!again) start_ = end_;
  if (varies()) evaluate();
}

void FlowPorts::set_time(double fraction)
{
  for (std::size_t n = 0; n < now_.size(); ++n)
    now_[n] = start_[n] + fraction * (end_[n] - start_[n]);
}

/* ---------------------------------------------------------------------- */

void FlowPorts::supply(fluid::Flow &flow, const FlowInside &inside)
{
  if (!stale_ && supplied_ == now_) return;
  fluid::ScalarField &supply = flow.supply();
  supply.clear();
  if (sources_.empty()) find_sources(flow, inside);
  for (std::size_t n = 0; n < ports_.size(); ++n) sources_[n].add(now_[n], supply);
  supplied_ = now_;
  stale_ = false;
}

/* ----------------------------------------------------------------------
   the cells with centres in the region of a port, and in that of the vessel, where one is given
------------------------------------------------------------------------- */

void FlowPorts::find_sources(const fluid::Flow &flow, const FlowInside &inside)
{
  const auto vessel = inside.enclosure();
  for (const Port *port : ports_) {
    const std::string use = "f" + port->style.substr(1);
    const RegionEnclosure opening(fixed_region(lmp, port->region, use), domain);
    const auto contains = [&](const fluid::Real3 &x) {
      const rbc::Vec3 centre{x[0], x[1], x[2]};
      return opening.contains(centre) && (!vessel || vessel->contains(centre));
    };
    sources_.emplace_back(flow.grid(), flow.decomposition(), contains, spread_of(kernel_));
    if (sources_.back().volume() == 0)
      error->all(FLERR, "Region {} for {} holds no centre of a cell of the fluid's grid{}",
                 port->region, use, vessel ? " inside the vessel" : "");
  }
}

/* ---------------------------------------------------------------------- */

std::size_t FlowPorts::place(const Port *port) const
{
  return std::find(ports_.begin(), ports_.end(), port) - ports_.begin();
}

double FlowPorts::rate(const Port *port) const
{
  const std::size_t n = place(port);
  return n < supplied_.size() ? supplied_[n] : 0;
}

double FlowPorts::volume(const Port *port, const fluid::Flow &flow, const FlowInside &inside)
{
  if (sources_.empty()) find_sources(flow, inside);
  return sources_[place(port)].volume();
}

double FlowPorts::pressure(const Port *port, fluid::Flow &flow, const FlowInside &inside,
                           bigint version)
{
  if (measured_ != version) {
    if (sources_.empty()) find_sources(flow, inside);
    const fluid::ScalarField &pressure = flow.pressure();
    pressures_.clear();
    for (const fluid::SmoothSource &source : sources_)
      pressures_.push_back(source.mean(pressure, world));
  }
  measured_ = version;
  return pressures_[place(port)] - pressures_.back();
}

std::size_t FlowPorts::bytes() const
{
  std::size_t sum = 0;
  for (const fluid::SmoothSource &source : sources_) sum += source.bytes();
  return sum;
}
