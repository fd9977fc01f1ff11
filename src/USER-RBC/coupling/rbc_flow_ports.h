#ifndef LMP_RBC_FLOW_PORTS_H
#define LMP_RBC_FLOW_PORTS_H

#include "coupling/rbc_flow_inside.h"
#include "coupling/rbc_port.h"
#include "fluid/smooth_source.h"
#include "fluid/spreading.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// The ports of a flow, whose rates sum to zero.
class FlowPorts : protected Pointers {
 public:
  using Pointers::Pointers;

  /// At the start of a run, collective. There must be a port.
  void connect(std::vector<const Port *> ports);

  /// Call when regions or the decomposition of the flow may have changed: cells are found anew with
  /// the next solve.
  void forget()
  {
    sources_.clear();
    stale_ = true;
  }

  bool varies() const;

  // Time, as of FlowForcing.

  void evaluate();
  void begin_step(bool again);
  void set_time(double fraction);

  /// Kernel of the walls, to which what enters is fitted. Before a solve.
  void set_kernel(fluid::KernelKind kernel) { kernel_ = kernel; }

  /// Before a solve: takes the present rates into the flow. Collective.
  void supply(fluid::Flow &flow, const FlowInside &inside);

  /// Of the last solve; zero before the first.
  double rate(const Port *port) const;

  /// Volume of the cells of a port. Collective, like what follows.
  double volume(const Port *port, const fluid::Flow &flow, const FlowInside &inside);

  /// Mean pressure in a port less that in the last, in units of the flow. Computed once for each
  /// `version`, which costs a solve.
  double pressure(const Port *port, fluid::Flow &flow, const FlowInside &inside, bigint version);

  std::size_t bytes() const;

 private:
  std::vector<const Port *> ports_;
  fluid::KernelKind kernel_ = fluid::default_kernel;
  std::vector<fluid::SmoothSource> sources_;    ///< of the ports; empty until they are found
  std::vector<double> start_, end_, now_;       ///< rates in the step
  std::vector<double> supplied_, pressures_;
  bool stale_ = true;    ///< what was supplied, of other cells
  bigint measured_ = -1;

  std::size_t place(const Port *port) const;
  void check_rates() const;
  void find_sources(const fluid::Flow &flow, const FlowInside &inside);
};

}    // namespace LAMMPS_NS

#endif
