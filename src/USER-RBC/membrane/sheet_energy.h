#pragma once

namespace rbc {

/// Energy per stress-free area of a thin sheet as a function of i1 = lambda1^2 + lambda2^2 and J =
/// lambda1 lambda2, with its derivatives.
struct SheetEnergy {
  double density, by_i1, by_J;
};

}    // namespace rbc
