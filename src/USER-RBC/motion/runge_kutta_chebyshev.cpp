#include "motion/runge_kutta_chebyshev.h"

#include <algorithm>
#include <cstdio>
#include <string>

namespace rbc {

namespace {

constexpr double LARGEST_GROWTH = 1.2;    // third order: of a timestep over the one before
constexpr int STARTING_PARTS = 8;         // third order: parts of a step without a past

constexpr int MOST_RETAKES = 6;    // of a step: the last one is in 32 parts

static_assert(DisplacementHistory::LONGEST + StabilityEstimate::STATE == Integrator::STATE);

std::string short_number(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

/// Tells the motion of the parts of a step, until it goes out of scope.
class Divided {
 public:
  Divided(Motion &motion, int parts) : motion_(motion) { motion_.divide_step(parts); }
  ~Divided() { motion_.divide_step(1); }
  Divided(const Divided &) = delete;
  Divided &operator=(const Divided &) = delete;

 private:
  Motion &motion_;
};

}    // namespace

RungeKuttaChebyshev::RungeKuttaChebyshev(int stages, int order) :
    chebyshev_(order, work_), automatic_(stages == 0)
{
  chebyshev_.measures_rate_back = automatic_;
  if (stages > 0) chebyshev_.set_stages(stages);
}

double RungeKuttaChebyshev::largest_growth() const
{
  return past_steps() > 0 ? LARGEST_GROWTH : Integrator::largest_growth();
}

void RungeKuttaChebyshev::points_migrated(const Motion &motion, std::size_t points,
                                          const PointStore &store)
{
  if (past_steps() == 0) return;
  // The least over all points, found from counts: how many know at least n steps.
  double counts[DisplacementHistory::LONGEST + 1] = {static_cast<double>(points)};
  for (std::size_t n = 0; n < points; ++n)
    for (int steps = std::min(store.known_steps(n), past_steps()); steps > 0; --steps)
      counts[steps] += 1;
  motion.sum(counts, past_steps() + 1);
  known_steps_ = past_steps();
  while (known_steps_ > 0 && counts[known_steps_] < counts[0]) --known_steps_;
}

void RungeKuttaChebyshev::step(Motion &motion, PointStore &store, const StepStart &start,
                               Numbers &x)
{
  const double radius =
      automatic_ ? stability_.radius(motion, store, mode_vector(), start, bearable(start.dt)) : 0;
  load_past(store, start.dt);
  const bool starting = past_.steps() < past_steps();
  const int parts = std::max(starting ? STARTING_PARTS : 1, retakes_ > 0 ? 1 << (retakes_ - 1) : 1);
  if (parts > 1)
    step_in_parts(motion, start, radius, parts, x);
  else {
    choose_stages(start.dt, radius);
    chebyshev_.step(motion, start.dt, start.x, start.v, past_, x);
  }
  check_growth(motion, store, start, x, parts);
}

/// Points that are driven back faster than what the stages are stable for tell of modes that the
/// estimate has missed. Where only a few of many points grow, the others hide this rate: then a
/// sudden motion of these few leads to a new estimate. One that was made at this step is as good as
/// there is.
void RungeKuttaChebyshev::check_growth(Motion &motion, PointStore &store, const StepStart &start,
                                       const Numbers &x, int parts)
{
  grown_ = sudden_ = false;
  if (!automatic_) return;
  const double stiffness = chebyshev_.stability_limit(stages()) / chebyshev_.stability_limit(2);
  sudden_ = stability_.is_sudden(motion, start, x, stiffness);
  if (stability_.is_of_step(start.step)) return;
  const double limit = parts / start.dt * chebyshev_.stability_limit(stages());    // of the radius
  grown_ = chebyshev_.rate_back() > limit;
  if (grown_ || !sudden_) return;
  stability_.suspect(motion, store, mode_vector(), start, x);
  grown_ = stability_.radius(motion, store, mode_vector(), start, limit) > limit;
}

/// The radius up to which the stages are stable that are chosen for the last one.
double RungeKuttaChebyshev::bearable(double dt) const
{
  return chebyshev_.stability_limit(chebyshev_.stages_for(dt * stability_.last())) / dt;
}

void RungeKuttaChebyshev::load_past(const PointStore &store, double dt)
{
  past_.clear(past_steps());
  const int known = dt > LARGEST_GROWTH * past_dt_[0] ? 0 : known_steps_;
  for (int n = known - 1; n >= 0; --n) {
    store.load(n, scratch_);
    past_.add(past_dt_[n], scratch_);
  }
}

/// Each part is of second order. At the start of a run this makes the step as accurate as those
/// that follow.
void RungeKuttaChebyshev::step_in_parts(Motion &motion, const StepStart &start, double radius,
                                        int parts, Numbers &x)
{
  const double part = 1.0 / parts, dt = part * start.dt;
  const DisplacementHistory none;
  const Divided divided(motion, retakes_ > 0 ? parts : 1);
  choose_stages(dt, radius);
  x = start.x;
  velocity_ = start.v;
  for (int n = 0; n < parts; ++n) {
    if (n > 0) motion.velocity(x, n * part, velocity_);
    scratch_ = x;
    chebyshev_.step(motion, dt, scratch_, velocity_, none, x, n * part, part);
  }
}

void RungeKuttaChebyshev::choose_stages(double dt, double radius)
{
  if (!automatic_) return;
  const int stages = chebyshev_.stages_for(dt * radius);
  if (stages > ChebyshevMethod::MOST_STAGES)
    throw StepFailure("integrator rkc needs more than " +
                      std::to_string(ChebyshevMethod::MOST_STAGES) + " stages: the timestep " +
                      short_number(dt) + " is " + short_number(dt * radius) +
                      " times the time in which the fastest mode relaxes");
  chebyshev_.set_stages(stages);
}

void RungeKuttaChebyshev::accept(PointStore &store, const StepStart &start, const Numbers &x)
{
  retakes_ = 0;
  stability_.accept();
  if (past_steps() == 0) return;
  known_steps_ = std::min(past_.steps() + 1, past_steps());
  for (int n = past_steps() - 1; n > 0; --n) {
    store.load(n - 1, scratch_);
    store.store(n, scratch_);
  }
  std::rotate(past_dt_.begin(), past_dt_.end() - 1, past_dt_.end());
  past_dt_[0] = start.dt;
  move_along(x, -1, start.x, scratch_);
  store.store(0, scratch_);
  store.set_known_steps(known_steps_);
}

void RungeKuttaChebyshev::reject(const Motion &motion, PointStore &store, const StepStart &start,
                                 const Numbers &x)
{
  if (automatic_) stability_.suspect(motion, store, mode_vector(), start, x);
}

Integrator::State RungeKuttaChebyshev::state() const
{
  State state{};
  const auto estimate = stability_.state();
  std::copy(estimate.begin(), estimate.end(),
            std::copy(past_dt_.begin(), past_dt_.end(), state.begin()));
  return state;
}

void RungeKuttaChebyshev::restore(const State &state)
{
  std::copy_n(state.begin(), past_dt_.size(), past_dt_.begin());
  StabilityEstimate::State estimate;
  std::copy_n(state.begin() + past_dt_.size(), estimate.size(), estimate.begin());
  stability_.restore(estimate);
}

bool RungeKuttaChebyshev::retake()
{
  if (!automatic_ || retakes_ == MOST_RETAKES) return false;
  if (++retakes_ == 1 && !grown_) stability_.raise();
  return true;
}

std::size_t RungeKuttaChebyshev::bytes() const
{
  return work_->bytes() + chebyshev_.bytes() + past_.bytes() +
         (scratch_.capacity() + velocity_.capacity()) * sizeof(double);
}

}    // namespace rbc
