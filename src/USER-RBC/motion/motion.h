#pragma once

#include <cmath>
#include <vector>

namespace rbc {

/// Three numbers for each of this rank's points.
using Numbers = std::vector<double>;

/// Points that move as dX/dt = V(X, t): what an integrator knows of what it advances. All calls are collective.
class Motion {
 public:
  /// V at positions `x` and a fraction of the step. Comes with a guess in `v`.
  virtual void velocity(const Numbers &x, double fraction, Numbers &v) = 0;

  /// Adds `values` up over ranks.
  virtual void sum(double *values, int count) const = 0;

 protected:
  ~Motion() = default;
};

inline double dot(const Motion &motion, const Numbers &a, const Numbers &b)
{
  double value = 0;
  for (std::size_t i = 0; i < a.size(); ++i) value += a[i] * b[i];
  motion.sum(&value, 1);
  return value;
}

/// Length of a vector over all points, divided by the root of the number of points.
inline double root_mean_square(const Motion &motion, const Numbers &a)
{
  double values[2] = {0, a.size() / 3.0};
  for (double value : a) values[0] += value * value;
  motion.sum(values, 2);
  return values[1] > 0 ? std::sqrt(values[0] / values[1]) : 0;
}

}    // namespace rbc
