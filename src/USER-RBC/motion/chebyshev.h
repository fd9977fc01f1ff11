#pragma once

#include "motion/displacement_history.h"
#include "motion/work_vectors.h"

namespace rbc {

/// Runge-Kutta-Chebyshev method with s stages, for stiff problems with a nearly real spectrum
/// (Sommeijer, Shampine and Verwer, J. Comput. Appl. Math. 88 (1998) 315). It is of second order.
/// Applied to the deviation Y of the points from the cubic polynomial P through their last four
/// places,
///   Y' = V(P + Y) - P',
/// it becomes a method of third order at no cost but memory: its error is that of a solution that
/// nearly vanishes.
class ChebyshevMethod {
 public:
  /// Round-off grows with the square of the stages: to 1e-8 of a step at the most.
  static constexpr int LEAST_STAGES = 2, MOST_STAGES = 10000;

  /// `order` 2 or 3.
  explicit ChebyshevMethod(int order = 2, SharedWorkVectors work = std::make_shared<WorkVectors>());

  /// Steps that a DisplacementHistory must hold.
  int past_steps() const { return order_ == 2 ? 0 : DisplacementHistory::LONGEST; }

  /// Largest time step times spectral radius.
  double stability_limit(int stages) const;

  /// Fewest stages for a time step times spectral radius, MOST_STAGES + 1 where these are not
  /// enough.
  int stages_for(double stiffness) const;

  void set_stages(int stages);
  int stages() const { return static_cast<int>(stages_.size()); }

  /// Sets x to the positions a time dt after `start`, where the velocity is `velocity`; takes
  /// stages() - 1 evaluations. A call may make only a part of a time step: `begin` is the fraction
  /// of the step at which it begins, `part` the fraction that it covers.
  void step(Motion &motion, double dt, const Numbers &start, const Numbers &velocity,
            const DisplacementHistory &past, Numbers &x, double begin = 0, double part = 1);

  /// Makes step() measure rate_back(), which costs one sum over ranks.
  bool measures_rate_back = false;

  /// Of the last step(): the rate at which the points are driven back to where they came from,
  ///   - dX . dV / dX . dX
  /// with the changes of positions and velocities from the start to the last stage. In a motion
  /// that relaxes it is not above the spectral radius, and near it only if the fastest modes have
  /// grown.
  double rate_back() const { return rate_back_; }

  std::size_t bytes() const;

 private:
  /// Coefficients of a stage: Y = mu Y_1 + nu Y_2 + dt (rate V_1 + base V_0), with the deviations
  /// Y_1 and Y_2 of the last two stages from the start, the velocity V_1 at the last stage and V_0
  /// at the start. `at`: time of the stage as a fraction of the step.
  struct Stage {
    double mu, nu, rate, base, at;
  };

  void measure_rate_back(const Motion &motion, const Numbers &start, const Numbers &velocity,
                         const Numbers &x, const Numbers &rate);

  int order_;
  double damping_;
  std::vector<Stage> stages_;
  double rate_back_ = 0;
  SharedWorkVectors work_;
  Numbers first_rate_;    ///< third order
};

}    // namespace rbc
