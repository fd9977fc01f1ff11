#pragma once

#include "membrane/sheet_energy.h"

#include <algorithm>

namespace rbc {

/// Stiffens a sheet beyond a stretch lambda_c: k / 2 (i1 - i1_c)^2 per stress-free area where i1
/// exceeds i1_c = lambda_c^2 + 1 / lambda_c^2, that of a uniaxial stretch at constant area.
struct StretchLimit {
  double stiffness = 0;    ///< k, force per length
  double i1 = 0;           ///< i1_c
};

inline SheetEnergy stretch_limit(const StretchLimit &limit, double i1)
{
  const double beyond = std::max(0.0, i1 - limit.i1);
  return {limit.stiffness / 2 * beyond * beyond, limit.stiffness * beyond, 0};
}

}    // namespace rbc
