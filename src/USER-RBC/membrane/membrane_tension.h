#pragma once

#include "membrane/membrane_model.h"

#include <Eigen/Geometry>

namespace rbc {

/// Isotropic tension (T1 + T2)/2 of the membrane at each vertex of a whole cell, bending apart:
/// that of the triangles around it, in proportion to their area. With T1 = dW/dlambda1 / lambda2
/// it is  i1/J dW/di1 + dW/dJ.
inline void vertex_tension(const SurfaceTemplate &shape, const MembraneParameters &parameters,
                           const std::vector<Vec3> &x, std::vector<double> &tension)
{
  tension.assign(shape.vertex_count(), 0.0);
  std::vector<double> vertex_area(shape.vertex_count());
  double area = 0;
  for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
    const auto &[i, j, k] = shape.triangles[t];
    const ReferenceTriangle &reference = shape.reference[t];
    const Vec3 e1 = x[j] - x[i], e2 = x[k] - x[i];
    const double share = e1.cross(e2).norm() / 2, J = share / reference.area;
    const double i1 = reference.g11 * e1.squaredNorm() + 2 * reference.g12 * e1.dot(e2) +
                      reference.g22 * e2.squaredNorm();
    const SheetEnergy sheet =
        std::visit([&](const auto &law) { return law(i1, J); }, parameters.law);
    const double by_i1 = sheet.by_i1 + stretch_limit(parameters.stretch, i1).by_i1;
    const double mean = by_i1 * i1 / J + sheet.by_J + parameters.local_area * (J - 1);
    for (int v : {i, j, k}) {
      tension[v] += share * mean;
      vertex_area[v] += share;
    }
    area += share;
  }
  const double of_whole_cell = parameters.global_area * (area - shape.area) / shape.area;
  for (int v = 0; v < shape.vertex_count(); ++v)
    tension[v] = tension[v] / vertex_area[v] + of_whole_cell;
}

}    // namespace rbc
