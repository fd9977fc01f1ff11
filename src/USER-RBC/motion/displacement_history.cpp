#include "motion/displacement_history.h"

#include <algorithm>

namespace rbc {

void DisplacementHistory::clear(int most)
{
  most_ = most;
  steps_ = 0;
}

void DisplacementHistory::add(double span, const Numbers &moved)
{
  if (most_ == 0) return;
  std::rotate(moved_.begin(), moved_.begin() + most_ - 1, moved_.begin() + most_);
  std::rotate(spans_.begin(), spans_.begin() + most_ - 1, spans_.begin() + most_);
  moved_[0] = moved;
  spans_[0] = span;
  steps_ = std::min(steps_ + 1, most_);
}

/// The place k steps ago is X - moved_0 - .. - moved_k-1: displacement n counts, negative, in the
/// Lagrange polynomials of all places before it.
DisplacementHistory::Weights DisplacementHistory::weights(double t, bool derivative) const
{
  std::array<double, LONGEST + 1> time{};
  for (int k = 0; k < steps_; ++k) time[k + 1] = time[k] - spans_[k];

  Weights w{};
  for (int k = 1; k <= steps_; ++k) {
    double value = 1, slope = 0;
    for (int m = 0; m <= steps_; ++m) {
      if (m == k) continue;
      const double scale = 1 / (time[k] - time[m]);
      slope = scale * (slope * (t - time[m]) + value);
      value *= scale * (t - time[m]);
    }
    for (int n = 0; n < k; ++n) w[n] -= derivative ? slope : value;
  }
  return w;
}

void DisplacementHistory::add_to(Numbers &sum, const Weights &weights, double factor) const
{
  for (int n = 0; n < steps_; ++n) {
    const double weight = factor * weights[n];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * moved_[n][i];
  }
}

std::size_t DisplacementHistory::bytes() const
{
  std::size_t sum = 0;
  for (const Numbers &numbers : moved_) sum += numbers.capacity();
  return sum * sizeof(double);
}

}    // namespace rbc
