#pragma once

#include "motion/integrator.h"

namespace rbc {

/// Explicit midpoint method. In the middle of the step a velocity at the start that is that of half
/// a step before is as good: the method stays of second order.
class Midpoint : public Integrator {
 public:
  int order() const override { return 2; }
  bool allows_inertia() const override { return true; }

  void step(Motion &motion, PointStore &, const StepStart &start, Numbers &x) override
  {
    move_along(start.x, 0.5 * start.dt, start.v, x);
    velocity_ = start.v;
    motion.velocity(x, 0.5, velocity_);
    move_along(start.x, start.dt, velocity_, x);
  }

  std::size_t bytes() const override { return velocity_.capacity() * sizeof(double); }

 private:
  Numbers velocity_;
};

}    // namespace rbc
