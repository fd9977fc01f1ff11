#pragma once

#include "geometry/plain_vector.h"
#include "geometry/tight_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rbc {

/// Positions as they were, and how far points have moved since. They are kept in single precision
/// from a place near all of them: that takes half the memory, and displacements are known to
/// error(), less than a millionth of how far apart points are.
class HeldPositions {
 public:
  /// Three numbers for each point.
  void hold(const double *x, int points)
  {
    const std::size_t size = 3 * std::size_t(points);
    double lowest[3], extent = 0;
    for (int d = 0; d < 3; ++d) {
      double lo = std::numeric_limits<double>::max(), hi = -lo;
      for (std::size_t n = d; n < size; n += 3) {
        lo = std::min(lo, x[n]);
        hi = std::max(hi, x[n]);
      }
      lowest[d] = points > 0 ? lo : 0;
      extent = std::max(extent, hi - lo);
    }
    origin_ = {lowest[0], lowest[1], lowest[2]};
    error_ = std::sqrt(3.0) * std::numeric_limits<float>::epsilon() / 2 * extent;
    resize_tightly(held_, size);
    for (std::size_t n = 0; n < size; ++n) held_[n] = static_cast<float>(x[n] - lowest[n % 3]);
  }

  int points() const { return static_cast<int>(held_.size() / 3); }

  /// Of a position along any direction, at most.
  double error() const { return error_; }

  PlainVector operator[](int n) const
  {
    const float *const at = &held_[3 * std::size_t(n)];
    return {origin_.x + at[0], origin_.y + at[1], origin_.z + at[2]};
  }

  PlainVector displacement(const double *x, int n) const { return at(x, n) - (*this)[n]; }

  /// Not more than it is, and less by twice error() at most: 0 where nothing has moved.
  double largest_displacement(const double *x) const
  {
    double largest2 = 0;
    for (int n = 0; n < points(); ++n) largest2 = std::max(largest2, squared_displacement(x, n));
    return std::max(0.0, std::sqrt(largest2) - error_);
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

  std::size_t bytes() const { return held_.capacity() * sizeof(float); }

 private:
  PlainVector origin_{0, 0, 0};
  double error_ = 0;
  std::vector<float> held_;

  /// Infinite for what is not a number.
  double squared_displacement(const double *x, int n) const
  {
    const PlainVector moved = displacement(x, n);
    const double sum = dot(moved, moved);
    return sum >= 0 ? sum : std::numeric_limits<double>::infinity();
  }
};

}    // namespace rbc
