#pragma once

#include "geometry/law_table.h"
#include "membrane/sheet_energy.h"

namespace rbc {

/// Skalak et al., Biophys. J. 13 (1973) 245, with I1 = i1 - 2 and I2 = J^2 - 1:
///   W = G_s/4 (I1^2 + 2 I1 - 2 I2 + C I2^2).
/// G_s is a force per length, C a number. Must be free of branches, see sheet_laws.h.
class Skalak {
 public:
  static constexpr const char *name = "skalak";
  static constexpr std::array<LawParameter, 2> parameters{
      {{"Gs", Bound::positive}, {"C", Bound::not_negative}}};

  Skalak(double Gs, double C) : quarter_(Gs / 4), C_(C) {}

  SheetEnergy operator()(double i1, double J) const
  {
    const double I1 = i1 - 2, I2 = J * J - 1;
    return {quarter_ * (I1 * I1 + 2 * I1 - 2 * I2 + C_ * I2 * I2), quarter_ * (2 * I1 + 2),
            quarter_ * 2 * J * (2 * C_ * I2 - 2)};
  }

 private:
  double quarter_, C_;
};

}    // namespace rbc
