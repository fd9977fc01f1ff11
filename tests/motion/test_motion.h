#pragma once

#include "motion/motion.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace test {

using rbc::Numbers;

/// Points whose velocity is a given function of their positions and of the fraction of the step;
/// counts evaluations.
class GivenMotion : public rbc::Motion {
 public:
  using Velocity = std::function<void(const Numbers &x, double fraction, Numbers &v)>;

  explicit GivenMotion(Velocity velocity) : velocity_(std::move(velocity)) {}

  void velocity(const Numbers &x, double fraction, Numbers &v) override
  {
    v.resize(x.size());
    velocity_(x, fraction, v);
    ++evaluations;
  }
  void sum(double *, int) const override {}

  int evaluations = 0;

 private:
  Velocity velocity_;
};

inline Numbers difference(const Numbers &a, const Numbers &b)
{
  Numbers c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] - b[i];
  return c;
}

inline double largest(const Numbers &a)
{
  double size = 0;
  for (double value : a) size = std::max(size, std::abs(value));
  return size;
}

/// Rows of a square matrix.
using Matrix = std::vector<Numbers>;

inline Numbers product(const Matrix &matrix, const Numbers &x)
{
  Numbers y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += matrix[i][j] * x[j];
  return y;
}

/// V(X) = A X.
inline GivenMotion linear_motion(const Matrix &matrix)
{
  return GivenMotion([matrix](const Numbers &x, double, Numbers &v) { v = product(matrix, x); });
}

}    // namespace test
