#pragma once

#include "motion/motion.h"

#include <algorithm>

namespace rbc {

/// Choice of the time step by the local error.
struct StepControl {
  double tolerance = 0;    ///< root mean square error of a position per step; 0: no control
  double largest = 0, smallest = 0;
  double growth = 2;    ///< largest ratio to the step before
  int order = 2;        ///< of the integrator

  bool active() const { return tolerance > 0; }

  /// Estimates the local error of a step (Sommeijer, Shampine and Verwer 1998): root mean square
  /// over all points of 0.8 (start - end) + 0.4 dt (start_velocity + end_velocity). It vanishes for
  /// positions quadratic in time. Collective.
  static double error(const Motion &motion, double dt, const Numbers &start, const Numbers &end,
                      const Numbers &start_velocity, const Numbers &end_velocity)
  {
    return root_mean_square(motion, start.size(), [&](std::size_t i) {
      return 0.8 * (start[i] - end[i]) + 0.4 * dt * (start_velocity[i] + end_velocity[i]);
    });
  }

  /// Time step that should meet the tolerance after one of dt had that error.
  double next(double dt, double error) const
  {
    const double wanted = error > 0 ? 0.8 * std::pow(tolerance / error, 1.0 / (order + 1)) : growth;
    return std::min(dt * std::clamp(wanted, 0.1, growth), largest);
  }

  /// Time step after one of dt that had no result.
  static double after_failure(double dt) { return 0.25 * dt; }
};

}    // namespace rbc
