#pragma once

#include "motion/motion.h"

namespace rbc {

/// Largest relaxation rate of a motion, by the power method on differences of its velocity
/// (Sommeijer, Shampine and Verwer, J. Comput. Appl. Math. 88 (1998) 315).
class SpectralRadius {
 public:
  double tolerance = 0.01;    ///< change of the estimate at which iterations end
  int max_iterations = 100;

  /// Iterations at least, for a guess that may hold little of the fastest mode: at first slower
  /// modes seem to be all.
  int min_iterations = 1;

  /// `size` is how far points are displaced (root mean square). `mode` holds a first guess of the
  /// fastest mode, not zero, and becomes it; `velocity` is that at x. One evaluation per iteration.
  double estimate(Motion &motion, const Numbers &x, const Numbers &velocity, double size,
                  Numbers &mode);

  /// A step from `start` to `end` went wrong: if it was unstable it grew along the fastest mode, of
  /// which the last one found may hold nothing. What it moved points by, other than along their
  /// `velocity` at its start, becomes part of the guess.
  void suspect(const Motion &motion, const Numbers &start, const Numbers &end,
               const Numbers &velocity, Numbers &mode);

 private:
  Numbers displaced_, changed_;
};

}    // namespace rbc
