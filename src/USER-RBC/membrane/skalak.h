#pragma once

#include "membrane/sheet_energy.h"

namespace rbc {

/// Skalak et al., Biophys. J. 13 (1973) 245, with I1 = i1 - 2 and I2 = J^2 - 1:
///   W = G_s/4 (I1^2 + 2 I1 - 2 I2 + C I2^2).
class Skalak {
 public:
  Skalak(double Gs, double C) : quarter_(Gs / 4), C_(C) {}

  SheetEnergy operator()(double i1, double J) const
  {
    const double I1 = i1 - 2, I2 = J * J - 1;
    return {quarter_ * (I1 * I1 + 2 * I1 - 2 * I2 + C_ * I2 * I2), quarter_ * (2 * I1 + 2),
            quarter_ * 2 * J * (2 * C_ * I2 - 2)};
  }

  double shear_modulus() const { return 4 * quarter_; }

 private:
  double quarter_, C_;
};

}    // namespace rbc
