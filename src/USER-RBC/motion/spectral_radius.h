#pragma once

#include "motion/work_vectors.h"

#include <utility>

namespace rbc {

/// Largest relaxation rate of a motion, by the power method on differences of its velocity
/// (Sommeijer, Shampine and Verwer, J. Comput. Appl. Math. 88 (1998) 315).
class SpectralRadius {
 public:
  /// Uses the last of these.
  explicit SpectralRadius(SharedWorkVectors work = std::make_shared<WorkVectors>()) :
      work_(std::move(work))
  {
  }

  double tolerance = 0.01;    ///< change of the estimate at which iterations end
  int max_iterations = 100;

  /// Iterations at least, for a guess that may hold little of the fastest mode: at first slower
  /// modes seem to be all.
  int min_iterations = 1;

  /// `size` is how far points are displaced (root mean square). `mode` holds a first guess of the
  /// fastest mode, not zero, and becomes it; `velocity` is that at x. One evaluation per iteration.
  double estimate(Motion &motion, const Numbers &x, const Numbers &velocity, double size,
                  Numbers &mode);

  /// Adds to `mode` how a rejected step moved the points from `start` to `end`, other than along
  /// their `velocity` at its start. If the step was unstable, this has grown along the fastest
  /// mode, which the last estimate may have missed.
  void suspect(const Motion &motion, const Numbers &start, const Numbers &end,
               const Numbers &velocity, Numbers &mode);

 private:
  SharedWorkVectors work_;

  Numbers &changed() { return (*work_)[2]; }
};

}    // namespace rbc
