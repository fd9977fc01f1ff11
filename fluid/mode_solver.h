#pragma once

#include "fluid/forcing.h"
#include "fluid/fourier.h"

#include <memory>

namespace fluid {

/// Solves the discrete problem (shift - viscosity lap) u + grad p = f, div u = s on the staggered
/// grid, mode by mode in x and y.
class ModeSolver {
 public:
  virtual ~ModeSolver() = default;

  /// Replaces the modes of the force density in `spectrum` by those of the velocity, normalised for
  /// the unnormalised backward transform. Where `pressure` is given its modes are written too.
  /// `source` holds the modes of s; without it s is zero. A projection knows no sources. The mean
  /// of s does not count.
  virtual void solve(const std::array<View<Complex>, 3> &spectrum, const Forcing &forcing,
                     const View<Complex> *pressure, const View<Complex> *source) = 0;

  virtual void set_shift(double shift) = 0;

  /// Modes of the pressure that a projection keeps for the next solve; null for other schemes.
  virtual const Components<Complex, 1> *kept_pressure() const { return nullptr; }
};

/// Triply periodic. Where the mean velocity is held it is that of the forcing, and a uniform
/// pressure gradient balances the mean force; otherwise the mean obeys shift <u> = <f> + body.
std::unique_ptr<ModeSolver> make_periodic_modes(const Grid &grid, const Box &modes,
                                                double viscosity, double shift, bool hold_mean);

/// Plates at both ends of z, with the conditions of the grid. Exact to round-off: velocity and
/// pressure are not split.
std::unique_ptr<ModeSolver> make_coupled_modes(const Grid &grid, const Box &modes, double viscosity,
                                               double shift);

/// The same by a fractional step: momentum with the pressure of the solve before, then a projection
/// that makes the velocity free of divergence and changes the pressure (Guermond, Minev & Shen,
/// Comput. Methods Appl. Mech. Engrg. 195 (2006) 6011, section 3.4: incremental, rotational). The
/// velocity slips along the plates by the splitting error.
std::unique_ptr<ModeSolver> make_projected_modes(const Grid &grid, const Box &modes,
                                                 double viscosity, double shift);

}    // namespace fluid
