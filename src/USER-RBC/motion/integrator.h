#pragma once

#include "motion/motion.h"
#include "motion/work_vectors.h"

#include <array>

namespace rbc {

/// What is known at the start of a step: positions, velocities, timesteps of this step and of the
/// last one (0 without one), number of the step.
struct StepStart {
  const Numbers &x, &v;
  double dt, last_dt;
  std::int64_t step;
};

/// Vectors of three numbers, kept for each point from step to step and while points migrate between
/// ranks. An entry that was never stored is zero.
class PointStore {
 public:
  virtual void load(int vector, Numbers &values) const = 0;
  virtual void store(int vector, const Numbers &values) = 0;

  /// Steps since a point came into being, as far as set_known_steps counts them.
  virtual int known_steps(std::size_t point) const = 0;
  virtual void set_known_steps(int steps) = 0;

 protected:
  ~PointStore() = default;
};

/// A method that advances points by a step. All calls are collective. A step that has no result
/// throws StepFailure. A new method is a header that derives from this class, and a line in
/// motion/integrators.h.
class Integrator {
 public:
  /// What goes into restart files, besides the vectors of the points.
  static constexpr int STATE = 10;
  using State = std::array<double, STATE>;

  virtual ~Integrator() = default;

  /// Order of accuracy, for the choice of the timestep.
  virtual int order() const = 0;

  /// Largest ratio of a timestep to the one before.
  virtual double largest_growth() const { return 2; }

  /// Whether it may advance points in a fluid with inertia, whose velocities at the start of a step
  /// are those of the middle of the last step. There a call of velocity() or velocity_at_start()
  /// makes the fluid's step: only a method may that makes just one call, for the middle of the
  /// step.
  virtual bool allows_inertia() const { return false; }

  /// Number of vectors that it keeps for each point in the PointStore.
  virtual int kept_vectors() const { return 0; }

  /// Whether it uses PointStore::known_steps().
  virtual bool counts_steps() const { return false; }

  /// At the start of a run, once velocities are known. `length` is one over which velocities vary,
  /// for finite differences. `continues`: the points are where the last step left them and move
  /// with the velocities that it left, so that what was known of them is likely to hold.
  /// `forces_differ`: other forces act on them than in the run before.
  virtual void start_run(double /*length*/, bool /*continues*/, bool /*forces_differ*/) {}

  /// Call after points migrated between ranks and at the start of a run. `points`: number of points
  /// that this rank holds now. `store` has moved with them.
  virtual void points_migrated(const Motion & /*motion*/, std::size_t /*points*/,
                               const PointStore & /*store*/)
  {
  }

  /// x = the positions at the end of the step.
  virtual void step(Motion &motion, PointStore &store, const StepStart &start, Numbers &x) = 0;

  /// One of both follows each step(). accept(): the positions `x` are those of the end of the step.
  /// reject(): the step is made again from the same start, with another timestep or, where retake()
  /// allows it, with the same; `x` is how far it came if it had no result.
  virtual void accept(PointStore & /*store*/, const StepStart & /*start*/, const Numbers & /*x*/) {}
  virtual void reject(const Motion & /*motion*/, PointStore & /*store*/,
                      const StepStart & /*start*/, const Numbers & /*x*/)
  {
  }

  /// Whether the step() just made has moved the points as one that is unstable would.
  virtual bool has_grown() const { return false; }

  /// Whether the step() just made has taken a point far from where its velocity at the start would
  /// have. What was checked at an earlier stage need not hold at its end.
  virtual bool was_sudden() const { return false; }

  /// Whether a step that went wrong may be taken again with the same timestep, in another way.
  virtual bool can_retake() const { return false; }

  /// After reject(): the step is taken again with the same timestep. Returns false, and the run
  /// must stop, where all ways were tried since the last accept().
  virtual bool retake() { return false; }

  virtual int stages() const { return 0; }
  virtual double spectral_radius() const { return 0; }

  virtual State state() const { return {}; }
  virtual void restore(const State & /*state*/) {}

  /// Vectors that are of no use between the calls of its functions.
  WorkVectors &work() { return *work_; }

  virtual std::size_t bytes() const { return work_->bytes(); }

 protected:
  SharedWorkVectors work_ = std::make_shared<WorkVectors>();
};

}    // namespace rbc
