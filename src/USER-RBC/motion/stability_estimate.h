#pragma once

#include "motion/integrator.h"
#include "motion/spectral_radius.h"
#include "motion/work_vectors.h"

#include <algorithm>

namespace rbc {

/// Spectral radius for which steps must be stable, with a safety margin. It is estimated anew every
/// few steps, more often if it changes fast. If it has grown since the last estimate, it is
/// multiplied by the same ratio once more (at most 1.5), for the steps until the next one. The
/// fastest mode found is kept in a vector of the points; the next estimate starts from it. Where a
/// step went wrong the radius rises at once to a multiple of the one that failed, and falls back to
/// the estimates by 2 % in a step.
class StabilityEstimate {
 public:
  explicit StabilityEstimate(SharedWorkVectors work = std::make_shared<WorkVectors>()) :
      work_(work), spectrum_(work)
  {
  }

  /// At the start of a run; points are displaced by a small part of `length`. Where a run
  /// `continues` another the estimate in use stays, so that a run in pieces is that of one piece.
  /// Where forces differ from those of the run before, the first step makes it anew if it finds a
  /// radius that is not bearable.
  void start_run(double length, bool continues, bool forces_differ);

  /// The radius for a step; estimates it where it is due. `bearable` is the largest radius for
  /// which the stages chosen for last() are stable. Throws StepFailure if the radius is not a
  /// number.
  double radius(Motion &motion, PointStore &store, int mode_vector, const StepStart &start,
                double bearable);

  /// Whether a step that led to `end` took a point far from where its velocity at the start would
  /// have: a part of `length`, times `stiffness`, as fast modes have `stiffness` times the velocity
  /// for the same displacement.
  bool is_sudden(const Motion &motion, const StepStart &start, const Numbers &end,
                 double stiffness) const;

  /// A step that led to `end` was refused or is suspicious: modes may have become faster. What it
  /// grew along joins the mode.
  void suspect(const Motion &motion, PointStore &store, int mode_vector, const StepStart &start,
               const Numbers &end);

  /// The step is taken again with the same timestep: the radius rises.
  void raise();

  /// A step counts: a radius that has risen falls.
  void accept();

  double last() const { return std::max(radius_, least_); }

  /// Whether the last estimate was made at this step.
  bool is_of_step(std::int64_t step) const { return estimated_step_ == step; }

  /// In restart files, with the vector of the mode.
  static constexpr int STATE = 7;
  using State = std::array<double, STATE>;
  State state() const;
  void restore(const State &state);

 private:
  SharedWorkVectors work_;
  SpectralRadius spectrum_;
  double length_ = 0;
  double radius_ = 0, raw_radius_ = 0;    ///< with a margin; the last estimate as it was
  double least_ = 0;                      ///< radius in use at least; 0 where no step failed
  double risen_ = 0;                      ///< what it becomes with the next estimate
  bool suspected_ = false;                ///< a suspicious step's growth was added to the mode
  std::int64_t radius_step_ = -1;         ///< of the estimate in use; -1 where a new one is due
  std::int64_t estimated_step_ = -1;      ///< of the last estimate
  int interval_ = 0;                      ///< steps between estimates; 0 before the first run
  bool doubted_ = false;                  ///< the estimate in use is that of an earlier run

  Numbers &mode() { return (*work_)[0]; }
  Numbers &velocity() { return (*work_)[1]; }
  bool is_due(Motion &motion, const PointStore &store, int mode_vector, const StepStart &start,
              double bearable);
  bool is_exceeded(Motion &motion, const PointStore &store, int mode_vector, const StepStart &start,
                   double bearable);
  double measure(Motion &motion, const StepStart &start);
  void estimate(Motion &motion, PointStore &store, int mode_vector, const StepStart &start);
  void foresee(double last, std::int64_t step);
};

}    // namespace rbc
