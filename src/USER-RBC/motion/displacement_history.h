#pragma once

#include "motion/motion.h"

#include <array>

namespace rbc {

/// Where points were at the ends of the last steps, and the polynomial in time through these
/// places.
class DisplacementHistory {
 public:
  static constexpr int LONGEST = 3;

  int steps() const { return steps_; }

  /// Forgets all, and keeps up to `most` steps from now on.
  void clear(int most);

  /// A step that took `span` moved the points by `moved`.
  void add(double span, const Numbers &moved);

  /// Weights w of the displacements, the last first, in the polynomial P(t) = X + sum_n w_n moved_n
  /// at time t from now, and in its derivative.
  using Weights = std::array<double, LONGEST>;
  Weights position_weights(double t) const { return weights(t, false); }
  Weights velocity_weights(double t) const { return weights(t, true); }

  void add_to(Numbers &sum, const Weights &weights, double factor) const;

  std::size_t bytes() const;

 private:
  int most_ = 0, steps_ = 0;
  std::array<double, LONGEST> spans_{};
  std::array<Numbers, LONGEST> moved_;

  Weights weights(double t, bool derivative) const;
};

}    // namespace rbc
