#pragma once

#include "motion.h"

#include <array>

namespace rbc {

/// Where points were at the ends of the last steps, and the polynomial in time through these places.
class Path {
 public:
  static constexpr int LONGEST = 3;

  int steps() const { return steps_; }
  double last_span() const { return spans_[0]; }

  /// Forgets all, and keeps up to `most` steps from now on.
  void clear(int most);

  /// A step that took `span` moved the points by `moved`.
  void add(double span, const Numbers &moved);

  /// Displacement in the n-th last step, n = 0 .. steps() - 1, and the time it took.
  Numbers &moved(int n) { return moved_[n]; }
  double &span(int n) { return spans_[n]; }
  void set_steps(int steps) { steps_ = steps; }

  /// Weights w of the displacements in the polynomial P(t) = X + sum_n w_n moved(n) at time t from now, and in its
  /// derivative.
  using Weights = std::array<double, LONGEST>;
  Weights place(double t) const { return weights(t, false); }
  Weights speed(double t) const { return weights(t, true); }

  void add_to(Numbers &sum, const Weights &weights, double factor) const;

  std::size_t numbers() const;

 private:
  int most_ = 0, steps_ = 0;
  std::array<double, LONGEST> spans_{};
  std::array<Numbers, LONGEST> moved_;

  Weights weights(double t, bool derivative) const;
};

}    // namespace rbc
