#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rbc {

/// Positions as they were, and how far points have moved since.
class HeldPositions {
 public:
  void hold(const double *x, int points) { held_.assign(x, x + 3 * std::size_t(points)); }

  int points() const { return static_cast<int>(held_.size() / 3); }

  double largest_displacement(const double *x) const
  {
    double largest2 = 0;
    for (int n = 0; n < points(); ++n) largest2 = std::max(largest2, squared_displacement(x, n));
    return std::sqrt(largest2);
  }

  /// -1 if there is no point.
  int furthest_moved(const double *x) const
  {
    int furthest = -1;
    double largest2 = -1;
    for (int n = 0; n < points(); ++n) {
      const double squared = squared_displacement(x, n);
      if (squared <= largest2) continue;
      largest2 = squared;
      furthest = n;
    }
    return furthest;
  }

  std::size_t bytes() const { return held_.capacity() * sizeof(double); }

 private:
  std::vector<double> held_;

  /// Infinite for what is not a number.
  double squared_displacement(const double *x, int n) const
  {
    double sum = 0;
    for (std::size_t d = 3 * std::size_t(n); d < 3 * std::size_t(n) + 3; ++d)
      sum += (x[d] - held_[d]) * (x[d] - held_[d]);
    return sum >= 0 ? sum : std::numeric_limits<double>::infinity();
  }
};

}    // namespace rbc
