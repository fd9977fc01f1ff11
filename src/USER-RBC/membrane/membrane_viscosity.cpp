#include "membrane/membrane_viscosity.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rbc {

namespace {

using Tensor = Eigen::Matrix2d;

double contract(const Tensor &a, const Tensor &b)
{
  return (a.array() * b.array()).sum();
}

/// A triangle in its plane, in components on the edges out of its first corner.
class Plane {
 public:
  Plane(const SurfaceTemplate::Corners &corners, const Vec3 *x) :
      corners_(corners), e1_(x[corners[1]] - x[corners[0]]), e2_(x[corners[2]] - x[corners[0]])
  {
    Tensor metric;
    metric << e1_.squaredNorm(), e1_.dot(e2_), e1_.dot(e2_), e2_.squaredNorm();
    inverse_ = metric.inverse();
    area_ = std::sqrt(metric.determinant()) / 2;
  }

  double area() const { return area_; }

  /// Rate of deformation, covariant.
  Tensor rate(const Vec3 *v) const
  {
    const Vec3 w1 = v[corners_[1]] - v[corners_[0]], w2 = v[corners_[2]] - v[corners_[0]];
    const double mixed = (e1_.dot(w2) + e2_.dot(w1)) / 2;
    Tensor rate;
    rate << e1_.dot(w1), mixed, mixed, e2_.dot(w2);
    return rate;
  }

  /// Contravariant deviator of a covariant tensor.
  Tensor deviator(const Tensor &covariant) const
  {
    const Tensor mixed = inverse_ * covariant;
    return mixed * inverse_ - mixed.trace() / 2 * inverse_;
  }

  /// Forces on the corners that hold a contravariant tension.
  void pull(const Tensor &tension, std::vector<Vec3> &f) const
  {
    const Vec3 force1 = -area_ * (tension(0, 0) * e1_ + tension(0, 1) * e2_);
    const Vec3 force2 = -area_ * (tension(1, 0) * e1_ + tension(1, 1) * e2_);
    f[corners_[1]] += force1;
    f[corners_[2]] += force2;
    f[corners_[0]] -= force1 + force2;
  }

 private:
  const SurfaceTemplate::Corners &corners_;
  Vec3 e1_, e2_;
  Tensor inverse_;
  double area_;
};

/// Difference of the principal values of a rate with this deviator.
double shear(const Tensor &rate, const Tensor &deviator)
{
  return std::sqrt(std::max(0.0, 2 * contract(deviator, rate)));
}

}    // namespace

double viscous_forces(const SurfaceTemplate &shape, const SurfaceViscosity &viscosity,
                      const CellElements &elements, const std::vector<Vec3> &x,
                      const std::vector<Vec3> &v, std::vector<Vec3> &f)
{
  std::fill(f.begin(), f.end(), Vec3::Zero());
  double power = 0;
  for (int n = 0; n < elements.owned_triangles; ++n) {
    const auto &corners = shape.triangles[elements.triangles[n]];
    const Plane plane(corners, x.data());
    const Tensor rate = plane.rate(v.data()), deviator = plane.deviator(rate);
    const double eta = viscosity.thins() ? viscosity(shear(rate, deviator)) : viscosity.at_rest();
    const Tensor tension = 2 * eta * deviator;
    plane.pull(tension, f);
    if (elements.owned[corners[0]]) power += plane.area() * contract(tension, rate);
  }
  return power;
}

void viscous_forces_change(const SurfaceTemplate &shape, const SurfaceViscosity &viscosity,
                           const CellElements &elements, const std::vector<Vec3> &x, const Vec3 *v,
                           bool frozen, const std::vector<Vec3> &w, std::vector<Vec3> &f)
{
  std::fill(f.begin(), f.end(), Vec3::Zero());
  for (int n = 0; n < elements.owned_triangles; ++n) {
    const Plane plane(shape.triangles[elements.triangles[n]], x.data());
    const Tensor rate = plane.rate(v), deviator = plane.deviator(rate);
    const double speed = shear(rate, deviator);
    const Tensor change = plane.rate(w.data());
    Tensor tension = 2 * viscosity(speed) * plane.deviator(change);
    if (!frozen && speed > 0)
      tension += 4 * viscosity.slope(speed) * contract(deviator, change) / speed * deviator;
    plane.pull(tension, f);
  }
}

}    // namespace rbc
