#include "motion/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rbc {

/// With the usual damping of 2/13 the fastest modes fall to 0.95 in a step. Differences of past
/// places amplify what is left of them: somewhat stronger damping, at 1 % less stability.
ChebyshevMethod::ChebyshevMethod(int order, SharedWorkVectors work) :
    order_(order), damping_(order == 2 ? 2.0 / 13 : 0.25), work_(std::move(work))
{
}

double ChebyshevMethod::stability_limit(int stages) const
{
  return 2.0 / 3 * (double(stages) * stages - 1) * (1 - 2.0 / 15 * damping_);
}

int ChebyshevMethod::stages_for(double stiffness) const
{
  const double per_square = stability_limit(2) / 3;
  const double stages = std::ceil(std::sqrt(1 + stiffness / per_square));
  return static_cast<int>(std::clamp(stages, double(LEAST_STAGES), MOST_STAGES + 1.0));
}

void ChebyshevMethod::set_stages(int s)
{
  if (s == stages()) return;
  const double w0 = 1 + damping_ / (double(s) * s);
  // Chebyshev polynomials at w0 and their first two derivatives
  std::vector<double> T(s + 1), T1(s + 1), T2(s + 1), b(s + 1), c(s + 1);
  T[0] = 1;
  T[1] = w0;
  T1[1] = 1;
  for (int j = 2; j <= s; ++j) {
    T[j] = 2 * w0 * T[j - 1] - T[j - 2];
    T1[j] = 2 * T[j - 1] + 2 * w0 * T1[j - 1] - T1[j - 2];
    T2[j] = 4 * T1[j - 1] + 2 * w0 * T2[j - 1] - T2[j - 2];
  }
  const double w1 = T1[s] / T2[s];
  for (int j = 2; j <= s; ++j) {
    b[j] = T2[j] / (T1[j] * T1[j]);
    c[j] = w1 * T2[j] / T1[j];
  }
  b[0] = b[1] = b[2];
  c[1] = c[2] / T1[2];

  stages_.resize(s);
  stages_[0] = {0, 0, 0, b[1] * w1, c[1]};
  for (int j = 2; j <= s; ++j) {
    const double rate = 2 * b[j] * w1 / b[j - 1], a = 1 - b[j - 1] * T[j - 1];
    stages_[j - 1] = {2 * b[j] * w0 / b[j - 1], -b[j] / b[j - 2], rate, -a * rate, c[j]};
  }
}

void ChebyshevMethod::step(Motion &motion, double dt, const Numbers &start, const Numbers &velocity,
                           const DisplacementHistory &past, Numbers &x, double begin, double part)
{
  const std::size_t n = start.size();
  Numbers &rate = (*work_)[0], &deviation = (*work_)[1], &before = (*work_)[2];
  for (auto *vector : {&deviation, &before}) vector->assign(n, 0.0);
  x.resize(n);
  rate = velocity;
  const auto place = [&](double at) {
    for (std::size_t i = 0; i < n; ++i) x[i] = start[i] + deviation[i];
    past.add_to(x, past.position_weights(at * dt), 1);
  };

  if (past.steps() > 0) {
    first_rate_ = velocity;
    past.add_to(first_rate_, past.velocity_weights(0), -1);
  }
  const Numbers &first_rate = past.steps() > 0 ? first_rate_ : velocity;
  for (std::size_t i = 0; i < n; ++i) deviation[i] = dt * stages_[0].base * first_rate[i];
  for (int j = 1; j < stages(); ++j) {
    const double at = stages_[j - 1].at;
    place(at);
    motion.velocity(x, begin + part * at, rate);
    past.add_to(rate, past.velocity_weights(at * dt), -1);
    const Stage &stage = stages_[j];
    for (std::size_t i = 0; i < n; ++i) {
      const double next = stage.mu * deviation[i] + stage.nu * before[i] +
                          dt * (stage.rate * rate[i] + stage.base * first_rate[i]);
      before[i] = deviation[i];
      deviation[i] = next;
    }
    past.add_to(rate, past.velocity_weights(at * dt), 1);
  }
  if (measures_rate_back) measure_rate_back(motion, start, velocity, x, rate);
  place(1);
}

void ChebyshevMethod::measure_rate_back(const Motion &motion, const Numbers &start,
                                        const Numbers &velocity, const Numbers &x,
                                        const Numbers &rate)
{
  double sums[2] = {0, 0};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double change = rate[i] - velocity[i], distance = x[i] - start[i];
    sums[0] -= distance * change;
    sums[1] += distance * distance;
  }
  motion.sum(sums, 2);
  rate_back_ = sums[1] > 0 ? sums[0] / sums[1] : 0;
}

std::size_t ChebyshevMethod::bytes() const
{
  return first_rate_.capacity() * sizeof(double);
}

}    // namespace rbc
