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
  /// Computes the velocities of all points at positions `x` and at the time that lies at `fraction`
  /// of the step (0 start, 1 end). `v` is input and output: on entry it is a guess, from which
  /// iterative solvers start. May throw on all ranks together if there is no result.
  virtual void velocity(const Numbers &x, double fraction, Numbers &v) = 0;

  /// Makes `v` the velocity at the positions `x` of the start of the step, where it is not that
  /// already: in a fluid with inertia. In one without, StepStart::v needs nothing.
  virtual void velocity_at_start(const Numbers & /*x*/, Numbers & /*v*/) {}

  /// Adds `values` up over ranks.
  virtual void sum(double *values, int count) const = 0;

  /// A number of each point's own, whatever rank holds it.
  virtual std::int64_t label(std::size_t point) const { return static_cast<std::int64_t>(point); }

  /// Between estimate_spectrum(true) and estimate_spectrum(false), velocity() only serves to
  /// estimate the spectral radius, and the points never take the positions that it is given. The
  /// motion may leave out effects that can only slow the fastest modes (viscosity of membranes,
  /// walls), and must not refuse high speeds.
  virtual void estimate_spectrum(bool /*on*/) {}

  /// While the spectrum is estimated, velocity() may leave out that velocities of points depend on
  /// those of others. Then `change`, a difference of two such results, lacks this dependence: this
  /// function adds it.
  virtual void complete_change(Numbers & /*change*/) {}

  /// The step is taken as that many equal parts, one after the other: what a point may cross in a
  /// step is what it may cross in a part. 1 is the rule.
  virtual void divide_step(int /*parts*/) {}

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

/// Length of a vector over all points, divided by the root of the number of points. This rank has
/// `count` of its numbers, number(i).
template <typename Number>
double root_mean_square(const Motion &motion, std::size_t count, const Number &number)
{
  double values[2] = {0, count / 3.0};
  for (std::size_t i = 0; i < count; ++i) values[0] += number(i) * number(i);
  motion.sum(values, 2);
  return values[1] > 0 ? std::sqrt(values[0] / values[1]) : 0;
}

inline double root_mean_square(const Motion &motion, const Numbers &a)
{
  return root_mean_square(motion, a.size(), [&](std::size_t i) { return a[i]; });
}

/// result = x + span * v
inline void move_along(const Numbers &x, double span, const Numbers &v, Numbers &result)
{
  result.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i] + span * v[i];
}

}    // namespace rbc
