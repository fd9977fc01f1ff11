#pragma once

#include "geometry/law_table.h"
#include "membrane/sheet_energy.h"

namespace rbc {

/// Incompressible neo-Hookean sheet in plane stress (lambda3 = 1/J):
///   W = G_s/2 (i1 + 1/J^2 - 3).
/// G_s is a force per length. Must be free of branches, see sheet_laws.h.
class NeoHookean {
 public:
  static constexpr const char *name = "neo-hookean";
  static constexpr std::array<LawParameter, 1> parameters{{{"Gs", Bound::positive}}};

  explicit NeoHookean(double Gs) : half_(Gs / 2) {}

  SheetEnergy operator()(double i1, double J) const
  {
    const double over_J2 = 1 / (J * J);
    return {half_ * (i1 + over_J2 - 3), half_, -2 * half_ * over_J2 / J};
  }

 private:
  double half_;
};

}    // namespace rbc
