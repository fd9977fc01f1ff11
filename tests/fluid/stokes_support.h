#pragma once

#include "fluid/halo.h"
#include "fluid/stokes_solver.h"
#include "test_support.h"

namespace test {

/// (shift - viscosity lap) u + grad p = f, div u = 0 on a grid, with its fields on this rank.
class StokesCase {
 public:
  StokesCase(const Grid &grid, const Decomposition &decomposition, double viscosity, double shift,
             const Forcing &forcing = {}) :
      grid_(grid),
      brick_(decomposition.mine()), viscosity_(viscosity), shift_(shift), forcing_(forcing),
      halo_(grid, decomposition, 1), force_(halo_.box()), velocity_(halo_.box()),
      pressure_(halo_.box()), solver_(grid, decomposition, viscosity, shift, shift == 0)
  {
  }
  StokesCase(const StokesCase &) = delete;
  StokesCase &operator=(const StokesCase &) = delete;

  const Box &brick() const { return brick_; }
  const VectorField &velocity() const { return velocity_; }
  const ScalarField &pressure() const { return pressure_; }

  /// Solves for the force density value(c, x) and fills the ghosts of the solution.
  template <typename Value> void solve(const Value &value)
  {
    set_vector(force_, grid_, brick_, value);
    solver_.velocity(force_, forcing_, velocity_);
    solver_.pressure(force_, forcing_, pressure_);
    halo_.fill(velocity_.views());
    halo_.fill(pressure_.views());
  }
  void solve_noise()
  {
    solve([this](int c, const Real3 &x) {
      return noise(c, std::lround(2 * (x[0] - grid_.origin[0]) / grid_.spacing[0]),
                   std::lround(2 * (x[1] - grid_.origin[1]) / grid_.spacing[1]),
                   std::lround(2 * (x[2] - grid_.origin[2]) / grid_.spacing[2]));
    });
  }

  /// Largest residuals of the discrete equations over all ranks.
  struct Residual {
    double momentum = 0, divergence = 0;
    double force = 0;       ///< largest force density
    double term = 0;        ///< largest term of the sum that makes the momentum residual
    double gradient = 0;    ///< largest term of the sum that makes the divergence
    double plate = 0;       ///< largest velocity through a plate
    double mean_pressure = 0;
  };

  Residual residual() const
  {
    Residual r;
    const Real3 mean = mean_force();
    const auto count = [](double &largest, double value) {
      largest = std::max(largest, std::isnan(value) ? HUGE_VAL : std::abs(value));
    };
    for_each(brick_, [&](int i, int j, int k) {
      double divergence = 0;
      for (int d = 0; d < 3; ++d) {
        const double low = u(d, i, j, k) / grid_.spacing[d],
                     high = u(d, i + (d == 0), j + (d == 1), k + (d == 2)) / grid_.spacing[d];
        divergence += high - low;
        count(r.gradient, low);
      }
      count(r.divergence, divergence);
      r.mean_pressure += pressure_[0](i, j, k) / grid_.size();

      for (int c = 0; c < 3; ++c) {
        const double f = force_[c](i, j, k);
        count(r.force, f);
        if (grid_.plates && c == 2 && k == 0) {
          count(r.plate, velocity_[c](i, j, k));
          continue;
        }
        double sum = shift_ * u(c, i, j, k) - f + mean[c] - (grid_.plates ? forcing_.body[c] : 0);
        count(r.term, shift_ * u(c, i, j, k));
        for (int d = 0; d < 3; ++d) {
          const int x = d == 0, y = d == 1, z = d == 2;
          const double b = viscosity_ / (grid_.spacing[d] * grid_.spacing[d]);
          sum -= b * (u(c, i + x, j + y, k + z) - 2 * u(c, i, j, k) + u(c, i - x, j - y, k - z));
          count(r.term, 2 * b * u(c, i, j, k));
        }
        const double h = grid_.spacing[c];
        const double p[2]{pressure_[0](i - (c == 0), j - (c == 1), k - (c == 2)),
                          pressure_[0](i, j, k)};
        sum += (p[1] - p[0]) / h;
        count(r.term, p[1] / h);
        count(r.momentum, sum);
      }
    });
    reduce(MPI_MAX, r.momentum, r.divergence, r.force, r.term, r.gradient, r.plate);
    reduce(MPI_SUM, r.mean_pressure);
    r.term = std::max(r.term, r.force);
    return r;
  }

 private:
  /// Velocity with the plates' rule. Without slip it is that of the plate midway between a point
  /// and its image beyond; with slip the image has the velocity of the point.
  double u(int c, int i, int j, int k) const
  {
    const int n = grid_.cells[2];
    const auto &field = velocity_[c];
    if (!grid_.plates) return field(i, j, k);
    if (c == 2) return k == 0 || k == n ? 0 : field(i, j, k);
    const auto image = [](PlateCondition condition, double plate, double inside) {
      return condition == PlateCondition::no_slip ? 2 * plate - inside : inside;
    };
    const auto &[lower, upper] = grid_.plate_conditions;
    if (k < 0) return image(lower, forcing_.plates.lower[c], field(i, j, 0));
    if (k >= n) return image(upper, forcing_.plates.upper[c], field(i, j, n - 1));
    return field(i, j, k);
  }

  /// What a uniform pressure gradient balances in a periodic Stokes flow.
  Real3 mean_force() const
  {
    Real3 mean{0, 0, 0};
    if (grid_.plates || shift_ > 0) return mean;
    for (int c = 0; c < 3; ++c)
      for_each(brick_, [&](int i, int j, int k) { mean[c] += force_[c](i, j, k) / grid_.size(); });
    reduce(MPI_SUM, mean[0], mean[1], mean[2]);
    return mean;
  }

  Grid grid_;
  Box brick_;
  double viscosity_, shift_;
  Forcing forcing_;
  Halo halo_;
  VectorField force_, velocity_;
  ScalarField pressure_;
  StokesSolver solver_;
};

/// Errors of velocity and pressure against an exact flow: velocity(c, x), pressure(x), force(c, x).
struct FlowErrors {
  Error velocity, pressure;
};

template <typename Exact>
FlowErrors errors(const Exact &exact, const Grid &grid, const Decomposition &decomposition)
{
  StokesCase stokes(grid, decomposition, exact.viscosity, exact.shift, exact.forcing);
  stokes.solve([&](int c, const Real3 &x) { return exact.force(c, x); });
  FlowErrors errors;
  for_each(stokes.brick(), [&](int i, int j, int k) {
    for (int c = 0; c < 3; ++c)
      errors.velocity.add(stokes.velocity()[c](i, j, k) -
                          exact.velocity(c, location(grid, c, i, j, k)));
    errors.pressure.add(stokes.pressure()[0](i, j, k) -
                        exact.pressure(location(grid, centre, i, j, k)));
  });
  return {errors.velocity.over_ranks(), errors.pressure.over_ranks()};
}

}    // namespace test
