#include "motion/stability_estimate.h"

#include <utility>

namespace rbc {

namespace {

// The interval between estimates is halved where the radius changes by more than FAST_CHANGE from
// one to the next, and doubled where it changes by less than STEADY_CHANGE.

constexpr int SHORTEST_INTERVAL = 5, LONGEST_INTERVAL = 50;
constexpr double STEADY_CHANGE = 0.01, FAST_CHANGE = 0.03;

constexpr double SAFETY = 1.06, LARGEST_GROWTH = 1.5;

// After a step that went wrong the next try has 1.5 times the stages. Then each step has 1 % fewer.

constexpr double RISE = 2.25, FALL = 0.98;
constexpr double LARGEST_RISE = 5;    // over the estimate

constexpr double DISPLACEMENT = 1.0e-5;    // over the length that the caller gives
constexpr int GUESS_ITERATIONS = 20;       // without a mode of an earlier estimate
constexpr int SUSPECT_ITERATIONS = 10;     // after a step that was refused or is suspicious

constexpr double SUDDEN = 0.2;    // distance over the length that the caller gives

/// Switches the motion's estimate of the spectrum on, and off when it goes out of scope.
class Estimating {
 public:
  explicit Estimating(Motion &motion) : motion_(motion) { motion_.estimate_spectrum(true); }
  ~Estimating() { motion_.estimate_spectrum(false); }
  Estimating(const Estimating &) = delete;
  Estimating &operator=(const Estimating &) = delete;

 private:
  Motion &motion_;
};

/// A mode without any symmetry, the same on any number of ranks.
void guess(const Motion &motion, Numbers &mode)
{
  for (std::size_t i = 0; i < mode.size(); ++i)
    mode[i] = std::sin(1.0 + 12.9898 * static_cast<double>(i % 3) +
                       78.233 * static_cast<double>(motion.label(i / 3)));
}

}    // namespace

void StabilityEstimate::start_run(double length, bool continues, bool forces_differ)
{
  length_ = length;
  doubted_ = forces_differ;
  if (continues && interval_ > 0) return;
  radius_step_ = estimated_step_ = -1;
  interval_ = SHORTEST_INTERVAL;
  raw_radius_ = least_ = risen_ = 0;
  suspected_ = false;
}

double StabilityEstimate::radius(Motion &motion, PointStore &store, int mode_vector,
                                 const StepStart &start, double bearable)
{
  if (is_due(motion, store, mode_vector, start, bearable))
    estimate(motion, store, mode_vector, start);
  if (risen_ > 0) least_ = std::min(std::exchange(risen_, 0.0), LARGEST_RISE * radius_);
  return last();
}

bool StabilityEstimate::is_due(Motion &motion, const PointStore &store, int mode_vector,
                               const StepStart &start, double bearable)
{
  const bool doubted = std::exchange(doubted_, false);
  if (radius_step_ < 0 || start.step >= radius_step_ + interval_) return true;
  return doubted && is_exceeded(motion, store, mode_vector, start, bearable);
}

/// Leaves what the stages depend on as it is, so that a run in pieces is that of one piece.
bool StabilityEstimate::is_exceeded(Motion &motion, const PointStore &store, int mode_vector,
                                    const StepStart &start, double bearable)
{
  store.load(mode_vector, mode());
  if (!(dot(motion, mode(), mode()) > 0)) return true;
  spectrum_.min_iterations = 1;
  return !(SAFETY * measure(motion, start) <= bearable);
}

void StabilityEstimate::estimate(Motion &motion, PointStore &store, int mode_vector,
                                 const StepStart &start)
{
  store.load(mode_vector, mode());
  const bool known = dot(motion, mode(), mode()) > 0;
  spectrum_.min_iterations = !known ? GUESS_ITERATIONS : suspected_ ? SUSPECT_ITERATIONS : 1;
  suspected_ = false;
  if (!known) guess(motion, mode());
  radius_step_ = start.step;
  if (root_mean_square(motion, mode()) == 0) {    // there are no points yet
    radius_ = 0;
    radius_step_ = -1;
    return;
  }

  const double last = std::exchange(raw_radius_, measure(motion, start));
  foresee(last, start.step);
  if (!std::isfinite(radius_)) throw StepFailure("the spectral radius is not a number");
  store.store(mode_vector, mode());
}

/// Starts from the guess mode(), which becomes the mode. start.v is no reference for the
/// differences: it may belong to forcing of another time, and it contains viscous forces, which are
/// solved for less exactly than differences need. So the velocities at start.x are evaluated once
/// more without these forces. Leaving them out is safe: they can only slow relaxation.
double StabilityEstimate::measure(Motion &motion, const StepStart &start)
{
  const Estimating estimating(motion);
  velocity() = start.v;
  motion.velocity(start.x, 0, velocity());
  return spectrum_.estimate(motion, start.x, velocity(), DISPLACEMENT * length_, mode());
}

void StabilityEstimate::foresee(double last, std::int64_t step)
{
  radius_ = SAFETY * raw_radius_;
  const bool repeated = std::exchange(estimated_step_, step) == step;
  if (repeated || !(last > 0)) return;    // nothing to compare with
  const double ratio = raw_radius_ / last, change = std::abs(ratio - 1);
  if (change > FAST_CHANGE)
    interval_ = std::max(interval_ / 2, SHORTEST_INTERVAL);
  else if (change < STEADY_CHANGE)
    interval_ = std::min(2 * interval_, LONGEST_INTERVAL);
  radius_ *= std::clamp(ratio, 1.0, LARGEST_GROWTH);
}

StabilityEstimate::State StabilityEstimate::state() const
{
  return {radius_,
          raw_radius_,
          double(suspected_),
          double(radius_step_),
          double(estimated_step_),
          double(interval_),
          least_};
}

void StabilityEstimate::restore(const State &state)
{
  radius_ = state[0];
  raw_radius_ = state[1];
  suspected_ = state[2] != 0;
  radius_step_ = static_cast<std::int64_t>(state[3]);
  estimated_step_ = static_cast<std::int64_t>(state[4]);
  interval_ = static_cast<int>(state[5]);
  least_ = state[6];
}

void StabilityEstimate::raise()
{
  risen_ = RISE * last();
}

void StabilityEstimate::accept()
{
  if (least_ > 0) least_ = FALL * least_ > radius_ ? FALL * least_ : 0;
}

bool StabilityEstimate::is_sudden(const Motion &motion, const StepStart &start, const Numbers &end,
                                  double stiffness) const
{
  const double furthest = SUDDEN * stiffness * length_;
  double count = 0;
  for (std::size_t i = 0; i < end.size(); i += 3) {
    double square = 0;
    for (std::size_t d = i; d < i + 3; ++d) {
      const double apart = end[d] - start.x[d] - start.dt * start.v[d];
      square += apart * apart;
    }
    if (!(square <= furthest * furthest)) count += 1;
  }
  motion.sum(&count, 1);
  return count > 0;
}

void StabilityEstimate::suspect(const Motion &motion, PointStore &store, int mode_vector,
                                const StepStart &start, const Numbers &end)
{
  store.load(mode_vector, mode());
  spectrum_.suspect(motion, start.x, end, start.v, mode());
  store.store(mode_vector, mode());
  suspected_ = true;
  radius_step_ = -1;
}

}    // namespace rbc
