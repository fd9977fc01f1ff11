#pragma once

#include "flow_support.h"

namespace test {

/// A number with its derivatives in x, y, z and time, and its second ones in x, y and z.
struct Jet {
  double value = 0;
  std::array<double, 4> slope{};
  Real3 curvature{};

  Jet(double value = 0) : value(value) {}
  static Jet variable(int direction, double value)
  {
    Jet jet(value);
    jet.slope[direction] = 1;
    return jet;
  }

  /// A function of this one, from its value and its first two derivatives.
  Jet through(double f, double first, double second) const
  {
    Jet jet(f);
    for (int d = 0; d < 4; ++d) jet.slope[d] = first * slope[d];
    for (int d = 0; d < 3; ++d)
      jet.curvature[d] = first * curvature[d] + second * slope[d] * slope[d];
    return jet;
  }

  friend Jet operator+(Jet a, const Jet &b)
  {
    a.value += b.value;
    for (int d = 0; d < 4; ++d) a.slope[d] += b.slope[d];
    for (int d = 0; d < 3; ++d) a.curvature[d] += b.curvature[d];
    return a;
  }
  friend Jet operator*(const Jet &a, const Jet &b)
  {
    Jet jet(a.value * b.value);
    for (int d = 0; d < 4; ++d) jet.slope[d] = a.slope[d] * b.value + a.value * b.slope[d];
    for (int d = 0; d < 3; ++d)
      jet.curvature[d] =
          a.curvature[d] * b.value + 2 * a.slope[d] * b.slope[d] + a.value * b.curvature[d];
    return jet;
  }
  friend Jet operator-(const Jet &a) { return a.through(-a.value, -1, 0); }
  friend Jet operator-(const Jet &a, const Jet &b) { return a + -b; }
  friend Jet sin(const Jet &a)
  {
    const double s = std::sin(a.value), c = std::cos(a.value);
    return a.through(s, c, -s);
  }
  friend Jet cos(const Jet &a)
  {
    const double s = std::sin(a.value), c = std::cos(a.value);
    return a.through(c, -s, -c);
  }
};

/// A flow that is given, and the force density that makes it: between plates at z = 0 and z =
/// height, which move in time or let the fluid slip, or triply periodic.
struct Manufactured {
  bool walls = true;
  PlateConditions conditions{};
  Real3 size{1, 1.25, 0.8};
  double viscosity = 0.05, density = 1.3;
  Inertia inertia = Inertia::convective;

  double velocity(int c, const Real3 &x, double t) const
  {
    return velocity(std::array<double, 3>{x[0], x[1], x[2]}, t)[c];
  }
  double pressure(const Real3 &x, double t) const { return pressure<double>(x, t); }
  Real3 plate(bool upper, double t) const { return plate<double>(upper, t); }

  /// density (du/dt + u . grad u) + grad p - viscosity lap u
  double force(int c, const Real3 &x, double t) const
  {
    const std::array<Jet, 3> at{Jet::variable(0, x[0]), Jet::variable(1, x[1]),
                                Jet::variable(2, x[2])};
    const Jet time = Jet::variable(3, t);
    const std::array<Jet, 3> u = velocity(at, time);
    double sum = density * u[c].slope[3] + pressure(at, time).slope[c];
    for (int d = 0; d < 3; ++d) {
      if (inertia == Inertia::convective) sum += density * u[d].value * u[c].slope[d];
      sum -= viscosity * u[c].curvature[d];
    }
    return sum;
  }

  Grid grid(const Index3 &cells) const
  {
    Grid grid{cells, {0, 0, 0}, {}, walls, conditions};
    for (int d = 0; d < 3; ++d) grid.spacing[d] = size[d] / cells[d];
    return grid;
  }

 private:
  /// Two rolls, a flow across them, and a mean flow, each with its own course in time.
  template <typename T> std::array<T, 3> velocity(const std::array<T, 3> &x, const T &t) const
  {
    using std::cos, std::sin;
    const double a = 2 * pi / size[0], b = 2 * pi / size[1];
    const auto [rise, slope, across] = profiles(x[2]);
    const T ax = a * x[0], by = b * x[1] + 1;
    const T one = sin(3 * t + 0.4), other = cos(2 * t), third = sin(5 * t);
    const std::array<T, 3> mean = mean_flow(x[2], t);
    return {-(1 / a) * one * sin(ax) * slope + mean[0],
            -(1 / b) * other * sin(by) * slope + third * sin(ax) * across + mean[1],
            (one * cos(ax) + other * cos(by)) * rise};
  }

  bool slips(bool upper) const
  {
    return (upper ? conditions.upper : conditions.lower) == PlateCondition::free_slip;
  }

  /// That of the velocity w, its derivative, and that of the flow across the rolls.
  template <typename T> struct Profiles {
    T rise, slope, across;
  };

  template <typename T> Profiles<T> profiles(const T &z) const
  {
    using std::cos, std::sin;
    const double g = (walls ? pi : 2 * pi) / size[2];
    const T sine = sin(g * z), cosine = cos(g * z);
    if (!walls) return {sine, g * cosine, sine};
    if (!slips(false) && !slips(true)) return {sine * sine, g * (2 * sine * cosine), sine * sine};
    const T s = (slips(false) ? 1 : -1) / size[2] * z + (slips(false) ? 0.0 : 1.0);
    const double turn = (slips(false) ? 2 : -2) / size[2];
    if (slips(false) && slips(true))
      return {2 * s * (1 - 2 * s * s + s * s * s), turn * (1 - 6 * s * s + 4 * s * s * s),
              1 + 3 * s * s - 2 * s * s * s};
    return {2 * s * (1 - 3 * s * s + 2 * s * s * s), turn * (1 - 9 * s * s + 8 * s * s * s),
            1 - s * s};
  }

  template <typename T> T pressure(const std::array<T, 3> &x, const T &t) const
  {
    using std::cos, std::sin;
    return cos(4 * t) * sin(2 * pi / size[0] * x[0]) * cos(2 * pi / size[1] * x[1]) *
           cos(2 * pi / size[2] * x[2]);
  }

  template <typename T> std::array<T, 3> plate(bool upper, const T &t) const
  {
    using std::cos, std::sin;
    if (!walls) return {0, 0, 0};
    if (upper) return {0.6 * cos(4 * t), 0.3 * sin(2 * t), 0};
    return {-0.4 * sin(3 * t), 0.2, 0};
  }

  template <typename T> std::array<T, 3> mean_flow(const T &z, const T &t) const
  {
    using std::cos, std::sin;
    if (!walls) return {0.3 * sin(2 * t), 0.3 * sin(2 * t), 0};
    const std::array<T, 3> low = plate(false, t), high = plate(true, t);
    if (slips(false) || slips(true)) {
      const std::array<T, 3> &held = slips(false) ? high : low;
      const T along = 0.3 * cos(t) * profiles(z).across;
      if (slips(false) && slips(true)) return {along, -along, 0};
      return {held[0] + along, held[1] - along, 0};
    }
    const T s = 1 / size[2] * z, parabola = cos(t) * s * (1 - s);
    return {low[0] + (high[0] - low[0]) * s + parabola, low[1] + (high[1] - low[1]) * s + parabola,
            0};
  }
};

/// Follows the given flow from time 0 on; forces stand on the grid itself.
class Follower {
 public:
  Follower(const Manufactured &exact, const Index3 &cells, const Decomposition &decomposition,
           Scheme scheme = Scheme::coupled) :
      exact_(exact),
      flow_(exact.grid(cells), decomposition, 1,
            FlowEquations{exact.viscosity, exact.density, exact.inertia, scheme, exact.walls})
  {
    flow_.set_velocity([&](int c, int i, int j, int k) {
      return exact_.velocity(c, location(flow_.grid(), c, i, j, k), 0);
    });
    flow_.forcing = forcing(0);
  }

  ForcedFlow &flow() { return flow_; }
  double time() const { return time_; }

  void step(double dt)
  {
    const double end = time_ + dt;
    set_vector(flow_.force(), flow_.grid(), flow_.brick(),
               [&](int c, const Real3 &x) { return exact_.force(c, x, time_ + 0.5 * dt); });
    step_to(flow_, dt, forcing(end));
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
  Forcing forcing(double t) const
  {
    Forcing forcing;
    forcing.plates = {exact_.plate(false, t), exact_.plate(true, t)};
    return forcing;
  }

  const Manufactured &exact_;
  ForcedFlow flow_;
  double time_ = 0;
};

}    // namespace test
