#pragma once

#include "membrane/dihedral_bending.h"

#include <algorithm>

namespace rbc {

/// Resists folds sharper than a mesh can show: nothing up to an angle theta_c between the normals
/// of neighboring triangles, k_c (cos theta_c - cos theta)^2 / (1 + cos theta) beyond, which grows
/// without bound towards 180 degrees.
struct CreaseResistance {
  double stiffness = 0;    ///< k_c, energy
  double cosine = 0;       ///< of theta_c
};

inline HingeEnergy crease_resistance(const CreaseResistance &crease, double sine, double cosine)
{
  const double beyond = std::max(0.0, crease.cosine - cosine), open = 1 + cosine;
  return {crease.stiffness * beyond * beyond / open,
          crease.stiffness * beyond * (open + 1 + crease.cosine) / (open * open) * sine};
}

}    // namespace rbc
