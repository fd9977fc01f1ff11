#pragma once

#include "geometry/law_table.h"
#include "membrane/sheet_energy.h"

namespace rbc {

/// Incompressible Mooney-Rivlin sheet of stress-free thickness h in plane stress (lambda3 = 1/J):
///   W = h [C1 (i1 + 1/J^2 - 3) + C2 (J^2 + i1/J^2 - 3)],   shear modulus G_s = 2 (C1 + C2) h.
/// C1 and C2 are forces per area, h is a length. Must be free of branches, see sheet_laws.h.
class MooneyRivlin {
 public:
  static constexpr const char *name = "mooney-rivlin";
  static constexpr std::array<LawParameter, 3> parameters{
      {{"C1", Bound::positive}, {"C2", Bound::not_negative}, {"h", Bound::positive}}};

  MooneyRivlin(double C1, double C2, double h) : c1_(C1 * h), c2_(C2 * h) {}

  SheetEnergy operator()(double i1, double J) const
  {
    const double over_J2 = 1 / (J * J);
    return {c1_ * (i1 + over_J2 - 3) + c2_ * (J * J + i1 * over_J2 - 3), c1_ + c2_ * over_J2,
            2 * (c2_ * J - (c1_ + c2_ * i1) * over_J2 / J)};
  }

 private:
  double c1_, c2_;
};

}    // namespace rbc
