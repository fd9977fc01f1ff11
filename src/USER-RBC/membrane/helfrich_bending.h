#pragma once

namespace rbc {

/// Energy of a vertex and its derivatives with respect to its area A and to the integral of the
/// mean curvature over it.
struct VertexEnergy {
  double value, by_area, by_integral;
};

/// 2 kappa A (H - H0)^2 with H = integral / A.
inline VertexEnergy helfrich_bending(double kappa, double area, double integral, double rest)
{
  const double curvature = integral / area, excess = curvature - rest;
  return {2 * kappa * excess * excess * area, -2 * kappa * excess * (curvature + rest),
          4 * kappa * excess};
}

}    // namespace rbc
