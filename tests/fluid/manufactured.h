#pragma once

#include "flow.h"
#include "test_support.h"

#include <functional>

namespace test {

/// A flow that is given, and the force density that makes it: between plates that move in time at z = 0 and
/// z = height (no slip), or triply periodic.
struct Manufactured {
  bool walls = true;
  Vec3 size{1, 1.25, 0.8};
  double viscosity = 0.05, density = 1.3;
  Inertia inertia = Inertia::convective;

  double phase(double t) const { return std::sin(3 * t + 0.4); }

  /// Two rolls, a flow across them, and a mean flow, each with its own course in time.
  double velocity(int c, const Vec3 &x, double t) const
  {
    const double a = 2 * pi / size[0], b = 2 * pi / size[1], g = (walls ? pi : 2 * pi) / size[2];
    const double z = x[2];
    const double rise = walls ? std::pow(std::sin(g * z), 2) : std::sin(g * z);
    const double slope = walls ? g * std::sin(2 * g * z) : g * std::cos(g * z);
    const double one = phase(t), other = std::cos(2 * t), third = std::sin(5 * t);
    const Vec3 low = plate(false, t), high = plate(true, t);
    switch (c) {
      case 0:
        return -one / a * std::sin(a * x[0]) * slope + mean(low[0], high[0], z, t);
      case 1:
        return -other / b * std::sin(b * x[1] + 1) * slope + mean(low[1], high[1], z, t) +
               third * std::sin(a * x[0]) * rise;
      default:
        return (one * std::cos(a * x[0]) + other * std::cos(b * x[1] + 1)) * rise;
    }
  }

  double pressure(const Vec3 &x, double t) const
  {
    return std::cos(4 * t) * std::sin(2 * pi * x[0] / size[0]) * std::cos(2 * pi * x[1] / size[1]) *
           std::cos(2 * pi * x[2] / size[2]);
  }

  Vec3 plate(bool upper, double t) const
  {
    if (!walls) return {0, 0, 0};
    return upper ? Vec3{0.6 * std::cos(4 * t), 0.3 * std::sin(2 * t), 0}
                 : Vec3{-0.4 * std::sin(3 * t), 0.2, 0};
  }

  /// density (du/dt + u . grad u) + grad p - viscosity lap u
  double force(int c, const Vec3 &x, double t) const
  {
    const auto shifted = [&](int d, double by) {
      Vec3 y = x;
      y[d] += by;
      return y;
    };
    double sum = density * derivative([&](double s) { return velocity(c, x, t + s); }) +
                 derivative([&](double s) { return pressure(shifted(c, s), t); });
    for (int d = 0; d < 3; ++d) {
      const auto along = [&](double s) { return velocity(c, shifted(d, s), t); };
      if (inertia == Inertia::convective) sum += density * velocity(d, x, t) * derivative(along);
      sum -= viscosity * second_derivative(along);
    }
    return sum;
  }

  Grid grid(const Index3 &cells) const
  {
    Grid grid{cells, {0, 0, 0}, {}, walls};
    for (int d = 0; d < 3; ++d) grid.spacing[d] = size[d] / cells[d];
    return grid;
  }

 private:
  double mean(double low, double high, double z, double t) const
  {
    if (!walls) return 0.3 * std::sin(2 * t);
    const double s = z / size[2];
    return low + (high - low) * s + std::cos(t) * s * (1 - s);
  }

  // Central differences of order 8: round-off, not the step, limits them.
  static constexpr double step = 0.01;

  template <typename F> static double derivative(const F &f)
  {
    const double w[]{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double sum = 0;
    for (int n = 1; n <= 4; ++n) sum += w[n - 1] * (f(n * step) - f(-n * step));
    return sum / step;
  }
  template <typename F> static double second_derivative(const F &f)
  {
    const double w[]{8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
    double sum = -205.0 / 72 * f(0);
    for (int n = 1; n <= 4; ++n) sum += w[n - 1] * (f(n * step) + f(-n * step));
    return sum / (step * step);
  }
};

/// Follows the given flow from time 0 on; forces stand on the grid itself.
class Follower {
 public:
  Follower(const Manufactured &exact, const Index3 &cells, const Decomposition &decomposition,
           Scheme scheme = Scheme::coupled) :
      exact_(exact),
      flow_(exact.grid(cells), decomposition, 1,
            Regime{exact.viscosity, exact.density, exact.inertia, scheme, exact.walls})
  {
    flow_.set_velocity([&](int c, int i, int j, int k) {
      return exact_.velocity(c, location(flow_.grid(), c, i, j, k), 0);
    });
    drive(0, flow_.drive);
  }

  Flow &flow() { return flow_; }
  double time() const { return time_; }

  void step(double dt)
  {
    const double end = time_ + dt;
    Drive start, finish;
    drive(time_, start);
    drive(end, finish);
    for (int d = 0; d < 3; ++d) {
      flow_.drive.walls.lower[d] = 0.5 * (start.walls.lower[d] + finish.walls.lower[d]);
      flow_.drive.walls.upper[d] = 0.5 * (start.walls.upper[d] + finish.walls.upper[d]);
    }
    set_vector(flow_.force(), flow_.grid(), flow_.brick(),
               [&](int c, const Vec3 &x) { return exact_.force(c, x, time_ + 0.5 * dt); });
    flow_.start_step(dt);
    flow_.drive = finish;
    flow_.finish_step();
    time_ = end;
  }

  Error error()
  {
    Error error;
    for_each(flow_.brick(), [&](int i, int j, int k) {
      for (int c = 0; c < 3; ++c)
        error.add(flow_.velocity()[c](i, j, k) -
                  exact_.velocity(c, location(flow_.grid(), c, i, j, k), time_));
    });
    return error.over_ranks();
  }

  /// Pressure belongs to the middle of the last step of length dt.
  Error pressure_error(double dt)
  {
    const ScalarField &p = flow_.pressure();
    Error error;
    for_each(flow_.brick(), [&](int i, int j, int k) {
      error.add(p[0](i, j, k) -
                exact_.pressure(location(flow_.grid(), centre, i, j, k), time_ - 0.5 * dt));
    });
    return error.over_ranks();
  }

 private:
  void drive(double t, Drive &drive) const
  {
    drive.walls = {exact_.plate(false, t), exact_.plate(true, t)};
  }

  const Manufactured &exact_;
  Flow flow_;
  double time_ = 0;
};

}    // namespace test
