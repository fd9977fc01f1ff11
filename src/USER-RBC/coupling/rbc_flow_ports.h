#ifndef LMP_RBC_FLOW_PORTS_H
#define LMP_RBC_FLOW_PORTS_H

#include "coupling/rbc_flow_inside.h"
#include "coupling/rbc_port.h"
#include "fluid/smooth_source.h"
#include "fluid/spreading.h"
#include "motion/linear_control.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// The ports of a flow. Their rates sum to zero: one of them takes what the others leave. Where
/// pressures are given, the rates of these ports are controlled; the last of them takes the rest.
class FlowPorts : protected Pointers {
 public:
  using Pointers::Pointers;

  /// At the start of a run, collective. There must be a port.
  void connect(std::vector<Port *> ports);

  /// Whether a run has begun since this port was defined.
  bool has(const Port *port) const { return place(port) < ports_.size(); }

  /// Call when regions or the decomposition of the flow may have changed: cells are found anew with
  /// the next solve.
  void forget()
  {
    sources_.clear();
    stale_ = true;
    measured_version_ = -1;
  }

  bool varies() const;

  // Time, as of FlowForcing.

  void evaluate();
  void begin_step(bool again);
  void set_time(double fraction);

  /// Spreads what enters as such walls need it. Call before the cells are found.
  void fit_to_wall(fluid::KernelKind kernel, fluid::MarkerKind kind);

  /// Before a solve: takes the present rates into the flow. Collective.
  void supply(fluid::Flow &flow, const FlowInside &inside);

  // Control of pressures, as of FlowForcing: what was measured is used by the next evaluate().

  bool controls() const { return controlled_.size() > 1; }
  bool probing() const { return controls() && control_.probing(); }
  bool probes_response() const { return controls() && control_.probes_response(); }
  bool knows_response() const { return controls() && known_ && !control_.probing(); }

  /// Probes with this velocity in the narrowest port whose pressure is held. Collective.
  void start_control(double velocity, const fluid::Flow &flow, const FlowInside &inside);
  void set_measured(const std::vector<double> &pressures);
  void hold_measured(const std::vector<double> &pressures);
  bool is_holding() const { return holding_; }
  bool agrees(const std::vector<double> &pressures) const;

  /// Where these agree: whether other pressures are wanted now than when they were measured. If so
  /// none are held any more, and the next evaluate() gives the rates that should cause those.
  bool follow_wanted();
  std::vector<double> control_state(const std::vector<double> &pressures) const;

  /// Of the last solve; zero before the first.
  double rate(const Port *port) const;

  /// Volume of the cells of a port. Collective, like what follows.
  double volume(const Port *port, const fluid::Flow &flow, const FlowInside &inside);

  /// Mean pressures in the ports less that in the one which takes the rest, in units of the flow.
  /// Computed once for each `version`, which costs a solve.
  const std::vector<double> &pressures(fluid::Flow &flow, const FlowInside &inside, bigint version);

  /// Of one of these pressures, with that of the port which takes the rest as it is given.
  double pressure(const Port *port, const std::vector<double> &pressures) const;

  /// Memory for a port.
  std::size_t bytes(const Port *port) const;

 private:
  std::vector<Port *> ports_;
  std::size_t rest_ = 0;                        ///< the port that takes the rest
  std::vector<std::size_t> controlled_;         ///< ports with a pressure
  double spread_ = 0;                           ///< of what enters, see fluid::SmoothSource
  std::vector<fluid::SmoothSource> sources_;    ///< of the ports; empty until they are found
  std::vector<double> start_, end_, now_;       ///< rates in the step
  std::vector<double> supplied_;
  std::vector<double> given_;    ///< values of the ports at the end of the step
  bool stale_ = true;            ///< what was supplied, of other cells

  std::vector<double> pressures_;
  bigint measured_version_ = -1;

  rbc::LinearControl control_;
  bool known_ = false;          // start_control() was called, or a restart file knows the response
  bool is_measured_ = false;    // since the last change of the rates
  bool holding_ = false;        // measured_ counts from the next step on
  std::vector<double> measured_, wanted_;    // the latter when the former were measured

  std::size_t place(const Port *port) const;
  void find_roles();
  void check_determined() const;
  void check_rates() const;
  void control();
  std::vector<double> wanted_now() const;
  std::vector<double> of_controlled(const std::vector<double> &values) const;
  void restore_control();
  void find_sources(const fluid::Flow &flow, const FlowInside &inside);
};

}    // namespace LAMMPS_NS

#endif
