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
    velocity_ = start.v;
    motion.velocity_at_start(start.x, velocity_);
    move_along(start.x, start.dt, velocity_, x);
  }

  std::size_t bytes() const override { return velocity_.capacity() * sizeof(double); }

 private:
  Numbers velocity_;
};

}    // namespace rbc
