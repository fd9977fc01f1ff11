#pragma once

#include "fluid/diagnostics.h"
#include "fluid/flow.h"

namespace test {

/// A flow with the forcing of its next solve.
class ForcedFlow : public fluid::Flow {
 public:
  using fluid::Flow::Flow;
  fluid::Forcing forcing;
  void solve() { Flow::solve(forcing); }
  void start_step(double dt) { Flow::start_step(dt, forcing); }
  void finish_step() { Flow::finish_step(forcing); }
  fluid::FlowDiagnostics diagnose() { return fluid::diagnose(*this, forcing); }
};

}    // namespace test
