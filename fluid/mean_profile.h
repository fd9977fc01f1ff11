#pragma once

#include "fluid/mode_solver.h"

namespace fluid {

/// Mean profiles over x and y between plates of u, v and p, and of the w that sources drive: the
/// plates and a uniform force drive the flow through these only.
class MeanProfile {
 public:
  MeanProfile(const Grid &grid, double viscosity);

  /// Solves (shift - viscosity d^2/dz^2) u = f; reads the mean modes of the force density. Without
  /// a shift one of the plates must hold the flow. `source` may be null.
  void solve(const std::array<View<Complex>, 3> &force, double shift, const Forcing &forcing,
             const View<Complex> *source);

  /// Writes the mean modes of the velocity, and of the pressure if given (its mean is zero).
  void store(const std::array<View<Complex>, 3> &velocity, const View<Complex> *pressure) const;

 private:
  Grid grid_;
  double viscosity_;
  std::array<std::vector<double>, 3> velocity_;
  std::vector<double> pressure_, ratio_;
  double pressure_offset_ = 0;

  double viscous_force(int k, double shift) const;
  void set_vertical(const View<Complex> &source, double scale);
};

}    // namespace fluid
