#pragma once

#include "membrane/sheet_energy.h"

namespace rbc {

/// Incompressible neo-Hookean sheet in plane stress (lambda3 = 1/J):
///   W = G_s/2 (i1 + 1/J^2 - 3).
class NeoHookean {
 public:
  explicit NeoHookean(double Gs) : half_(Gs / 2) {}

  SheetEnergy operator()(double i1, double J) const
  {
    const double over_J2 = 1 / (J * J);
    return {half_ * (i1 + over_J2 - 3), half_, -2 * half_ * over_J2 / J};
  }

  double shear_modulus() const { return 2 * half_; }

 private:
  double half_;
};

}    // namespace rbc
