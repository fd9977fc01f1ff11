#pragma once

#include "motion/integrator.h"

namespace rbc {

/// Adams-Bashforth method of second order for timesteps that vary. A point without a past takes an
/// Euler step.
class AdamsBashforth : public Integrator {
 public:
  int order() const override { return 2; }
  int kept_vectors() const override { return 1; }
  bool counts_steps() const override { return true; }

  void step(Motion &, PointStore &store, const StepStart &start, Numbers &x) override
  {
    const double half_ratio = start.last_dt > 0 ? 0.5 * start.dt / start.last_dt : 0;
    store.load(LAST_VELOCITY, last_);
    x.resize(start.x.size());
    for (std::size_t n = 0; n < x.size() / 3; ++n) {
      const double weight = store.known_steps(n) > 0 ? half_ratio : 0;
      for (std::size_t i = 3 * n; i < 3 * n + 3; ++i)
        x[i] = start.x[i] + start.dt * (start.v[i] + weight * (start.v[i] - last_[i]));
    }
  }

  void accept(PointStore &store, const StepStart &start, const Numbers &) override
  {
    store.store(LAST_VELOCITY, start.v);
    store.set_known_steps(1);
  }

  std::size_t bytes() const override { return work_->bytes() + last_.capacity() * sizeof(double); }

 private:
  static constexpr int LAST_VELOCITY = 0;
  Numbers last_;
};

}    // namespace rbc
