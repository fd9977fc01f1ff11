#pragma once

#include "coupling.h"

namespace fluid {

/// Mobility of pairs of markers in steady flow far from plates: that of the discrete equations and of the kernel, exact
/// but for the distant images of a periodic cube of grid cells.
class LatticeMobility {
 public:
  /// Reach in cells: for markers further apart along a direction images count.
  static constexpr int reach = 20;

  LatticeMobility(KernelKind kernel, const Grid &grid, double viscosity);

  /// Velocity of marker a by forces on marker b: nine numbers, [component of velocity][component of force].
  void pair(const double *a, const double *b, double *mobility) const;

  /// Mean mobility of a marker.
  double self() const { return self_; }

 private:
  KernelKind kernel_;
  Grid grid_;
  double self_ = 0;
  Box box_;    ///< differences of cells
  std::array<Components<double, 3>, 3> response_;    ///< to a force in each direction
};

}    // namespace fluid
