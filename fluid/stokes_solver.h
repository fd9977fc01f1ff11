#pragma once

#include "fluid/flow_equations.h"
#include "fluid/mode_solver.h"

namespace fluid {

/// Velocity (and pressure) of (shift - viscosity lap) u + grad p = f, div u = s for a force density
/// on the faces of a distributed staggered grid: exact for the discrete equations, but by
/// projection between plates.
class StokesSolver {
 public:
  /// `hold_mean` as for make_periodic_modes. It takes memory for at least `lent` numbers.
  StokesSolver(const Grid &grid, const Decomposition &decomposition, double viscosity, double shift,
               bool hold_mean, Scheme scheme = Scheme::coupled, std::size_t lent = 0);

  /// Memory to use between solves.
  double *lent() const { return fourier_.lent(); }

  void set_shift(double shift) { modes_->set_shift(shift); }

  /// Sets the velocity on this rank's brick from the force on all bricks; they may be the same
  /// field. `source` is s on this rank's brick, null where it is zero; a projection takes none. It
  /// costs a transform, and memory at the first call.
  void velocity(const VectorField &force, const Forcing &forcing, const VectorField &velocity,
                const ScalarField *source = nullptr);

  /// Sets the pressure (mean zero) that belongs to the force and the source; costs a solve, and
  /// memory at the first call. That of a projection is the one of the last solve.
  void pressure(const VectorField &force, const Forcing &forcing, const ScalarField &pressure,
                const ScalarField *source = nullptr);

  /// The modes kept from solve to solve (none but the pressure of a projection), and where they
  /// are.
  const Components<Complex, 1> *kept_modes() const { return modes_->kept_pressure(); }
  const std::vector<Box> &mode_bricks() const { return fourier_.mode_bricks(); }

  Traffic traffic() const { return fourier_.traffic(); }
  std::size_t bytes() const;

 private:
  std::array<View<Complex>, 3> spectrum() const;
  void solve(const VectorField &force, const Forcing &forcing, const View<Complex> *pressure,
             const ScalarField *source);

  Fourier fourier_;
  std::unique_ptr<ModeSolver> modes_;
  Components<Complex, 1> pressure_modes_, source_modes_;
};

}    // namespace fluid
