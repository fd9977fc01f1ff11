#include "membrane_viscosity.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rbc {

double viscous_forces(const SurfaceTemplate &shape, double viscosity, const CellElements &elements,
                      const std::vector<Vec3> &x, const std::vector<Vec3> &v, std::vector<Vec3> &f)
{
  std::fill(f.begin(), f.end(), Vec3::Zero());
  double power = 0;
  for (int n = 0; n < elements.loaded; ++n) {
    const auto &[i, j, k] = shape.triangles[elements.triangles[n]];
    const Vec3 e1 = x[j] - x[i], e2 = x[k] - x[i], w1 = v[j] - v[i], w2 = v[k] - v[i];
    Eigen::Matrix2d metric, rate;
    metric << e1.squaredNorm(), e1.dot(e2), e1.dot(e2), e2.squaredNorm();
    const double mixed = (e1.dot(w2) + e2.dot(w1)) / 2;
    rate << e1.dot(w1), mixed, mixed, e2.dot(w2);

    const Eigen::Matrix2d inverse = metric.inverse(), mixed_rate = inverse * rate;
    const Eigen::Matrix2d stress =
        2 * viscosity * (mixed_rate * inverse - mixed_rate.trace() / 2 * inverse);
    const double area = std::sqrt(metric.determinant()) / 2;
    const Vec3 force_j = -area * (stress(0, 0) * e1 + stress(0, 1) * e2);
    const Vec3 force_k = -area * (stress(1, 0) * e1 + stress(1, 1) * e2);
    f[j] += force_j;
    f[k] += force_k;
    f[i] -= force_j + force_k;
    if (elements.owned[i]) power += area * (stress.array() * rate.array()).sum();
  }
  return power;
}

}    // namespace rbc
