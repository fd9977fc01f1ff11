#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace rbc {

/// Three numbers for each of this rank's points.
using Numbers = std::vector<double>;

/// Points that move as dX/dt = V(X, t): what an integrator knows of what it advances. All calls are
/// collective.
class Motion {
 public:
  /// Makes `v` the velocity V at positions `x` and a fraction of the step. `v` comes with a guess
  /// of it.
  virtual void velocity(const Numbers &x, double fraction, Numbers &v) = 0;

  /// Makes `v` the velocity at the positions `x` of the start of the step, where it is not that
  /// already.
  virtual void velocity_at_start(const Numbers & /*x*/, Numbers & /*v*/) {}

  /// Adds `values` up over ranks.
  virtual void sum(double *values, int count) const = 0;

  /// A number of each point's own, whatever rank holds it.
  virtual std::int64_t label(std::size_t point) const { return static_cast<std::int64_t>(point); }

  /// While the spectrum is estimated, velocities belong to positions that the points do not take.
  /// The motion may leave out what only makes fast modes slower, and accepts any speed.
  virtual void estimate_spectrum(bool /*on*/) {}

 protected:
  ~Motion() = default;
};

/// Thrown on all ranks together when a step has no result.
struct StepFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
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

/// result = x + span * v
inline void move_along(const Numbers &x, double span, const Numbers &v, Numbers &result)
{
  result.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i] + span * v[i];
}

}    // namespace rbc
