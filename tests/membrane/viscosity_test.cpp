#include "membrane_viscosity.h"

#include "test_support.h"

namespace {

using rbc::CellElements;
using test::Matrix3;
using test::pi;
using test::Vertices;

struct Sphere {
  explicit Sphere(int frequency) :
      shape(test::icosphere(frequency).surface()), all(CellElements::whole(shape)), f(shape.size())
  {
  }

  /// Power dissipated where every vertex moves with `gradient` times its position.
  double power(double viscosity, const Matrix3 &gradient)
  {
    v = test::transformed(shape.vertices,
                          [&](const rbc::Vec3 &x) { return rbc::Vec3(gradient * x); });
    return rbc::viscous_forces(shape, viscosity, all, shape.vertices, v, f);
  }

  rbc::SurfaceTemplate shape;
  CellElements all;
  Vertices v, f;
};

/// A unit sphere in axisymmetric strain diag(-1/2, -1/2, 1): D_theta - D_phi = 3/2 sin^2 theta, and the power is
/// integral of eta (D_theta - D_phi)^2 = 24 pi / 5 eta.
TEST(MembraneViscosity, DissipatesWhatASphereInStrainDoes)
{
  const Matrix3 strain = rbc::Vec3(-0.5, -0.5, 1).asDiagonal();
  const double viscosity = 3, exact = 24 * pi / 5 * viscosity;
  double error[3];
  for (int n = 0; n < 3; ++n) error[n] = 1 - Sphere(4 << n).power(viscosity, strain) / exact;
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.05);
  EXPECT_LT(std::abs(error[2]), 5e-3);
}

TEST(MembraneViscosity, ResistsNeitherRigidMotionNorDilation)
{
  Sphere sphere(4);
  Matrix3 rotation;
  rotation << 0, -1, 2, 1, 0, 3, -2, -3, 0;
  for (const Matrix3 &gradient : {rotation, Matrix3(2 * Matrix3::Identity())}) {
    EXPECT_NEAR(sphere.power(1, gradient), 0, 1e-13);
    for (const rbc::Vec3 &force : sphere.f) EXPECT_LT(force.norm(), 1e-14);
  }
}

TEST(MembraneViscosity, ForcesDoMinusThePowerAndSumToZero)
{
  Sphere sphere(4);
  Matrix3 gradient;
  gradient << 1, 2, -3, 0.5, -2, 1, 0.2, 3, 1;
  const double power = sphere.power(2, gradient);
  double work = 0, size = 0;
  rbc::Vec3 sum = rbc::Vec3::Zero(), torque = rbc::Vec3::Zero();
  for (int i = 0; i < sphere.shape.size(); ++i) {
    work += sphere.f[i].dot(sphere.v[i]);
    sum += sphere.f[i];
    torque += sphere.shape.vertices[i].cross(sphere.f[i]);
    size += sphere.f[i].norm();
  }
  EXPECT_GT(power, 0);
  EXPECT_NEAR(work, -power, 1e-12 * power);
  EXPECT_LT(sum.norm(), 1e-14 * size);
  EXPECT_LT(torque.norm(), 1e-14 * size);
}

/// The resistance is a symmetric matrix: forces of one motion do as much work in another as the other way round.
TEST(MembraneViscosity, IsSymmetric)
{
  Sphere sphere(3);
  Matrix3 one, two;
  one << 1, 2, -3, 0.5, -2, 1, 0.2, 3, 1;
  two << 0, 1, 0, 0, 0, 2, 1, 1, -1;
  sphere.power(1, one);
  const Vertices force = sphere.f, velocity = sphere.v;
  sphere.power(1, two);
  double there = 0, back = 0;
  for (int i = 0; i < sphere.shape.size(); ++i) {
    there += force[i].dot(sphere.v[i]);
    back += sphere.f[i].dot(velocity[i]);
  }
  EXPECT_NEAR(there, back, 1e-12 * std::abs(there));
}

/// Parts of a cell that two ranks hold make up the whole.
TEST(MembraneViscosity, OfPartsIsThatOfTheWhole)
{
  Sphere sphere(3);
  Matrix3 gradient;
  gradient << 1, 2, -3, 0.5, -2, 1, 0.2, 3, 1;
  const double whole = sphere.power(1, gradient);
  const Vertices force = sphere.f;
  double sum = 0;
  for (int side : {0, 1}) {
    std::vector<char> owned(sphere.shape.size());
    for (int i = 0; i < sphere.shape.size(); ++i) owned[i] = i % 2 == side;
    const CellElements part = CellElements::part(sphere.shape, owned, false);
    sum += rbc::viscous_forces(sphere.shape, 1, part, sphere.shape.vertices, sphere.v, sphere.f);
    for (int i = 0; i < sphere.shape.size(); ++i) {
      if (owned[i]) {
        EXPECT_LT((sphere.f[i] - force[i]).norm(), 1e-14);
      }
    }
  }
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
}

}    // namespace
