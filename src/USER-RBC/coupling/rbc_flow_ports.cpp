#include "coupling/rbc_flow_ports.h"

#include "cells/rbc_region_enclosure.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

using namespace LAMMPS_NS;

// what rates may sum to, relative to the largest

static constexpr double SAME = 1.0e-9;

// Solves of the same forces differ by less than this part of the pressures that rates cause, as in
// FlowForcing.

static constexpr double SAME_PRESSURE = 1.0e-3;

// Values of a variable may differ by round-off after a restart, in parts of these pressures.

static constexpr double SAME_WANTED = 1.0e-9;

// In a port the flow along the wall grows, and that in the layer which the kernel blurs with it.
// What the layer needs beyond the wall must be supplied there: otherwise it passes the wall. These
// spreads were found by trial, in tubes 20 and 40 cells wide (examples/ports).

static double spread_of(fluid::KernelKind kernel, fluid::MarkerKind kind)
{
  if (kernel == fluid::KernelKind::roma3) return 0;
  return kind == fluid::MarkerKind::sheets ? 0.36 : 0.17;
}

/* ---------------------------------------------------------------------- */

void FlowPorts::connect(std::vector<Port *> ports)
{
  for (const Port *port : ports) port->value.check(lmp, "fix rbc/port");
  if (ports != ports_) {
    end_.assign(ports.size(), 0.0);
    known_ = holding_ = false;
    wanted_.clear();
  }
  ports_ = std::move(ports);
  find_roles();
  restore_control();
  forget();
  spread_ = 0;    // until walls are known
  supplied_.resize(ports_.size());
}

/* ----------------------------------------------------------------------
   which ports are controlled, and which one takes the rest
------------------------------------------------------------------------- */

void FlowPorts::find_roles()
{
  controlled_.clear();
  const Port *without = nullptr;
  rest_ = ports_.size() - 1;
  for (std::size_t n = 0; n < ports_.size(); ++n) {
    if (ports_[n]->given == Port::Given::pressure) controlled_.push_back(n);
    if (ports_[n]->given != Port::Given::nothing) continue;
    if (without)
      error->all(FLERR,
                 "{} and {} have neither flow nor pressure: only one port may be without, it takes "
                 "the rest",
                 without->style, ports_[n]->style);
    without = ports_[n];
    rest_ = n;
  }
  if (controlled_.empty()) return;
  rest_ = controlled_.back();
  if (without)
    error->all(FLERR,
               "{} has neither flow nor pressure: as {} has a pressure, give one or the other",
               without->style, ports_[rest_]->style);
}

bool FlowPorts::varies() const
{
  return controls() || std::any_of(ports_.begin(), ports_.end(),
                                   [](const Port *port) { return port->value.is_variable(); });
}

/* ---------------------------------------------------------------------- */

void FlowPorts::evaluate()
{
  modify->clearstep_compute();
  given_.resize(ports_.size());
  for (std::size_t n = 0; n < ports_.size(); ++n) {
    const Port &port = *ports_[n];
    given_[n] = port.value.value(lmp);
    if (!std::isfinite(given_[n]))
      error->all(FLERR, "{}: its {} is not a number at step {}", port.style,
                 port.given == Port::Given::pressure ? "pressure" : "flow", update->ntimestep);
    end_[n] = port.given == Port::Given::rate ? given_[n] : 0;
  }
  modify->addstep_compute(update->ntimestep + 1);

  if (controls()) control();
  if (ports_[rest_]->given == Port::Given::rate) check_rates();
  end_[rest_] -= std::accumulate(end_.begin(), end_.end(), 0.0);
  now_ = end_;
}

void FlowPorts::check_determined() const
{
  for (std::size_t n = 0; n < ports_.size(); ++n)
    if (!std::isfinite(end_[n]))
      error->all(
          FLERR,
          "{}: no flow gives it its pressure at step {}; ports with pressures must be openings "
          "of one vessel, each with a region of its own",
          ports_[n]->style, update->ntimestep);
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

void FlowPorts::fit_to_wall(fluid::KernelKind kernel, fluid::MarkerKind kind)
{
  spread_ = spread_of(kernel, kind);
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
  std::vector<fluid::SmoothSource> sources;
  for (const Port *port : ports_) {
    const std::string use = "f" + port->style.substr(1);
    const RegionEnclosure opening(fixed_region(lmp, port->region, use), domain);
    const auto contains = [&](const fluid::Real3 &x) {
      const rbc::Vec3 centre{x[0], x[1], x[2]};
      return opening.contains(centre) && (!vessel || vessel->contains(centre));
    };
    sources.emplace_back(flow.grid(), flow.decomposition(), contains, spread_);
    if (sources.back().volume() == 0)
      error->all(FLERR, "Region {} for {} holds no centre of a cell of the fluid's grid{}",
                 port->region, use, vessel ? " inside the vessel" : "");
    if (sources.back().is_whole_grid())
      error->all(FLERR, "Region {} for {} holds all of the fluid: a port is a part of it",
                 port->region, use);
  }
  sources_ = std::move(sources);
}

/* ----------------------------------------------------------------------
   of the ports with a pressure but for the one that takes the rest
------------------------------------------------------------------------- */

std::vector<double> FlowPorts::of_controlled(const std::vector<double> &values) const
{
  std::vector<double> some;
  for (std::size_t n : controlled_)
    if (n != rest_) some.push_back(values[n] - values[rest_]);
  return some;
}

std::vector<double> FlowPorts::wanted_now() const
{
  std::vector<double> wanted = of_controlled(given_);
  for (double &pressure : wanted) pressure *= force->ftm2v;
  return wanted;
}

void FlowPorts::control()
{
  const std::vector<double> wanted = wanted_now();
  if (!holding_) wanted_ = wanted;
  const bool learns = is_measured_ && control_.probing();
  if (is_measured_) control_.adjust(measured_, wanted);
  is_measured_ = false;
  for (std::size_t n = 0; n < wanted.size(); ++n) end_[controlled_[n]] = control_.inputs()[n];
  check_determined();
  if (learns && !control_.probing() && !control_.takes_work())
    error->all(FLERR,
               "{}: how its pressure responds to a flow was lost in the slip of the walls, as it "
               "would set free work at step {}: use a smaller tol of fix rbc/wall",
               ports_[controlled_.front()]->style, update->ntimestep);
}

void FlowPorts::start_control(double velocity, const fluid::Flow &flow, const FlowInside &inside)
{
  if (sources_.empty()) find_sources(flow, inside);
  double section = std::numeric_limits<double>::max();
  for (std::size_t n : controlled_)
    section = std::min(section, std::pow(sources_[n].volume(), 2.0 / 3));
  known_ = true;
  is_measured_ = holding_ = false;
  control_.probe(static_cast<int>(controlled_.size()) - 1, velocity * section);
}

void FlowPorts::set_measured(const std::vector<double> &pressures)
{
  if (!holding_) measured_ = of_controlled(pressures);
  holding_ = false;
  is_measured_ = true;
}

void FlowPorts::hold_measured(const std::vector<double> &pressures)
{
  if (!holding_) measured_ = of_controlled(pressures);
  holding_ = true;
}

bool FlowPorts::agrees(const std::vector<double> &pressures) const
{
  const std::vector<double> now = of_controlled(pressures);
  double apart = 0;
  for (std::size_t n = 0; n < now.size(); ++n)
    apart = std::max(apart, std::abs(now[n] - measured_[n]));
  return apart <= SAME_PRESSURE * control_.effect();
}

bool FlowPorts::follow_wanted()
{
  std::vector<double> change = wanted_now();
  if (wanted_.size() != change.size()) return false;    // of a file that has none
  double largest = 0;
  for (std::size_t n = 0; n < change.size(); ++n) {
    change[n] -= wanted_[n];
    largest = std::max(largest, std::abs(change[n]));
  }
  if (largest <= SAME_WANTED * control_.effect()) return false;
  control_.shift(change);
  holding_ = false;
  return true;
}

/* ----------------------------------------------------------------------
   measured pressures, what the control knows, and the pressures wanted then
------------------------------------------------------------------------- */

std::vector<double> FlowPorts::control_state(const std::vector<double> &pressures) const
{
  if (!knows_response()) return {};
  std::vector<double> state = holding_ ? measured_ : of_controlled(pressures);
  const std::vector<double> known = control_.state();
  state.insert(state.end(), known.begin(), known.end());
  state.insert(state.end(), wanted_.begin(), wanted_.end());
  return state;
}

void FlowPorts::restore_control()
{
  const std::vector<double> state = std::exchange(ports_.front()->remembered, {});
  for (Port *port : ports_) port->remembered.clear();    // the same, or of other ports
  const auto count = static_cast<std::ptrdiff_t>(controlled_.empty() ? 0 : controlled_.size() - 1);
  if (control_.inputs().size() != std::size_t(count)) known_ = false;
  const auto size = static_cast<std::ptrdiff_t>(state.size()), most = count * (count + 4);
  if (!controls() || (size != most && size != most - count)) return;    // without those wanted
  const auto first = state.begin() + count, last = first + count * (count + 2);
  control_.restore(static_cast<int>(count), {first, last});
  measured_.assign(state.begin(), first);
  wanted_.assign(last, state.end());
  known_ = holding_ = true;
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

const std::vector<double> &FlowPorts::pressures(fluid::Flow &flow, const FlowInside &inside,
                                                bigint version)
{
  if (measured_version_ == version) return pressures_;
  measured_version_ = version;
  if (sources_.empty()) find_sources(flow, inside);
  const fluid::ScalarField &pressure = flow.pressure();
  pressures_.clear();
  for (const fluid::SmoothSource &source : sources_)
    pressures_.push_back(source.core_mean(pressure, world));
  const double level = pressures_[rest_];
  for (double &value : pressures_) value -= level;
  return pressures_;
}

double FlowPorts::pressure(const Port *port, const std::vector<double> &pressures) const
{
  const double level = controlled_.empty() || given_.empty() ? 0 : given_[rest_];
  return pressures[place(port)] / force->ftm2v + level;
}

std::size_t FlowPorts::bytes(const Port *port) const
{
  return sources_.empty() ? 0 : sources_[place(port)].bytes();
}
