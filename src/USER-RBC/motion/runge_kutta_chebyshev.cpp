#include "motion/runge_kutta_chebyshev.h"

#include <algorithm>
#include <cstdio>
#include <string>

namespace rbc {

namespace {

constexpr double LARGEST_GROWTH = 1.2;    // third order: of a timestep over the one before
constexpr int STARTING_PARTS = 8;         // third order: parts of a step without a past

static_assert(DisplacementHistory::LONGEST + StabilityEstimate::STATE == Integrator::STATE);

std::string short_number(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

}    // namespace

RungeKuttaChebyshev::RungeKuttaChebyshev(int stages, int order) :
    chebyshev_(order), automatic_(stages == 0)
{
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
  const double radius = automatic_ ? stability_.radius(motion, store, mode_vector(), start) : 0;
  load_past(store, start.dt);
  if (past_.steps() < past_steps()) return start_without_past(motion, start, radius, x);
  choose_stages(start.dt, radius);
  chebyshev_.step(motion, start.dt, start.x, start.v, past_, x);
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

/// Divides the step, so that it is as accurate as those that follow.
void RungeKuttaChebyshev::start_without_past(Motion &motion, const StepStart &start, double radius,
                                             Numbers &x)
{
  constexpr double part = 1.0 / STARTING_PARTS;
  const double dt = part * start.dt;
  const DisplacementHistory none;
  choose_stages(dt, radius);
  x = start.x;
  velocity_ = start.v;
  for (int n = 0; n < STARTING_PARTS; ++n) {
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

std::size_t RungeKuttaChebyshev::bytes() const
{
  return chebyshev_.bytes() + past_.bytes() + stability_.bytes() +
         (scratch_.capacity() + velocity_.capacity()) * sizeof(double);
}

}    // namespace rbc
