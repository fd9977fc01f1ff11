#pragma once

#include "motion/integrator.h"

namespace rbc {

/// Explicit midpoint method. In a fluid with inertia the velocities at the start are those of half
/// a step before. They only serve to find the positions in the middle, with an error of second
/// order in dt, so the method stays of second order.
class Midpoint : public Integrator {
 public:
  int order() const override { return 2; }
  bool allows_inertia() const override { return true; }

  void step(Motion &motion, PointStore &, const StepStart &start, Numbers &x) override
  {
    move_along(start.x, 0.5 * start.dt, start.v, x);
    Numbers &velocity = work()[0] = start.v;
    motion.velocity(x, 0.5, velocity);
    move_along(start.x, start.dt, velocity, x);
  }
};

}    // namespace rbc
