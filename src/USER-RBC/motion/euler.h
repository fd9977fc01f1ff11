#pragma once

#include "motion/integrator.h"

namespace rbc {

/// Explicit Euler method.
class Euler : public Integrator {
 public:
  int order() const override { return 1; }
  bool allows_inertia() const override { return true; }

  void step(Motion &motion, PointStore &, const StepStart &start, Numbers &x) override
  {
    Numbers &velocity = work()[0] = start.v;
    motion.velocity_at_start(start.x, velocity);
    move_along(start.x, start.dt, velocity, x);
  }
};

}    // namespace rbc
