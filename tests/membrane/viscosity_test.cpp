#include "membrane/membrane_viscosity.h"

#include "test_support.h"

namespace {

using rbc::CellElements;
using rbc::SurfaceViscosity;
using test::Matrix3;
using test::pi;
using test::Vertices;

struct Sphere {
  explicit Sphere(int frequency) :
      shape(test::icosphere(frequency).surface()), all(CellElements::whole(shape)),
      f(shape.vertex_count())
  {
  }

  /// Power dissipated where every vertex moves with `gradient` times its position.
  double power(const SurfaceViscosity &viscosity, const Matrix3 &gradient)
  {
    v = test::transformed(shape.vertices,
                          [&](const rbc::Vec3 &x) { return rbc::Vec3(gradient * x); });
    return rbc::viscous_forces(shape, viscosity, all, shape.vertices, v, f);
  }

  rbc::SurfaceTemplate shape;
  CellElements all;
  Vertices v, f;
};

/// A unit sphere in axisymmetric strain diag(-1/2, -1/2, 1): D_theta - D_phi = 3/2 sin^2 theta, and
/// the power is integral of eta (D_theta - D_phi)^2 = 24 pi / 5 eta.
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
  for (int i = 0; i < sphere.shape.vertex_count(); ++i) {
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

/// The resistance is a symmetric matrix: forces of one motion do as much work in another as the
/// other way round.
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
  for (int i = 0; i < sphere.shape.vertex_count(); ++i) {
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
    std::vector<char> owned(sphere.shape.vertex_count());
    for (int i = 0; i < sphere.shape.vertex_count(); ++i) owned[i] = i % 2 == side;
    const CellElements part = CellElements::part(sphere.shape, owned, false);
    sum += rbc::viscous_forces(sphere.shape, 1, part, sphere.shape.vertices, sphere.v, sphere.f);
    for (int i = 0; i < sphere.shape.vertex_count(); ++i) {
      if (owned[i]) {
        EXPECT_LT((sphere.f[i] - force[i]).norm(), 1e-14);
      }
    }
  }
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
}

// ---- a viscosity that falls with the rate of shear

const SurfaceViscosity thinning(5, 0.7, 3);

double cross_law(double shear)
{
  return 0.7 + 4.3 * 3 / (3 + shear);
}

/// A rectangle of 2 by 1.5 in the plane of x and y: the upper face of a cuboid.
struct FlatSheet {
  FlatSheet() : shape(test::cuboid({2, 1.5, 1}, 3).surface()), f(shape.vertex_count())
  {
    face.owned.assign(shape.vertex_count(), 1);
    for (int t = 0; t < static_cast<int>(shape.triangles.size()); ++t) {
      const auto &corners = shape.triangles[t];
      if (std::all_of(corners.begin(), corners.end(),
                      [&](int i) { return std::abs(height(i) - top()) < 1e-12; }))
        face.triangles.push_back(t);
    }
    face.owned_triangles = static_cast<int>(face.triangles.size());
  }

  double height(int i) const { return shape.vertices[i][2]; }
  double top() const
  {
    double highest = height(0);
    for (int i = 1; i < shape.vertex_count(); ++i) highest = std::max(highest, height(i));
    return highest;
  }

  double power(const Matrix3 &gradient)
  {
    const Vertices v = test::transformed(
        shape.vertices, [&](const rbc::Vec3 &x) { return rbc::Vec3(gradient * x); });
    return rbc::viscous_forces(shape, thinning, face, shape.vertices, v, f);
  }

  /// Tension across the side of largest x: minus the force on its vertices over its length.
  rbc::Vec3 tension() const
  {
    double side = shape.vertices[0][0];
    for (const rbc::Vec3 &x : shape.vertices) side = std::max(side, x[0]);
    rbc::Vec3 sum = rbc::Vec3::Zero();
    for (int i = 0; i < shape.vertex_count(); ++i)
      if (std::abs(shape.vertices[i][0] - side) < 1e-12) sum -= f[i];
    return sum / 1.5;
  }

  rbc::SurfaceTemplate shape;
  CellElements face;
  Vertices f;
};

/// Tension eta(D1 - D2) (2 D - tr D) and power eta(D1 - D2) (D1 - D2)^2 per area.
TEST(ThinningViscosity, OfAFlatSheetFollowsTheLaw)
{
  FlatSheet sheet;
  ASSERT_EQ(sheet.face.owned_triangles, 18);
  for (double rate : {0.01, 1.0, 30.0}) {
    Matrix3 simple_shear = Matrix3::Zero();
    simple_shear(0, 1) = rate;
    const Matrix3 planar = rbc::Vec3(rate, -rate, 0).asDiagonal(),
                  one_sided = rbc::Vec3(rate, 0, 0).asDiagonal();
    struct {
      const Matrix3 &gradient;
      double shear;
      rbc::Vec3 tension;
    } const cases[] = {
        {simple_shear, rate, {0, cross_law(rate) * rate, 0}},
        {planar, 2 * rate, {cross_law(2 * rate) * 2 * rate, 0, 0}},
        {one_sided, rate, {cross_law(rate) * rate, 0, 0}},
    };
    for (const auto &[gradient, shear, tension] : cases) {
      const double power = 3 * cross_law(shear) * shear * shear;
      EXPECT_NEAR(sheet.power(gradient), power, 1e-12 * power);
      EXPECT_LT((sheet.tension() - tension).norm(), 1e-12 * tension.norm());
    }
  }
}

TEST(ThinningViscosity, ChangeIsTheDerivativeOfTheForces)
{
  Sphere sphere(3);
  Matrix3 one, two;
  one << 1, 2, -3, 0.5, -2, 1, 0.2, 3, 1;
  two << 0, 1, 0, 0, 0, 2, 1, 1, -1;
  const Vertices &x = sphere.shape.vertices;
  sphere.power(thinning, one);
  const Vertices v = sphere.v;
  sphere.power(thinning, two);
  const Vertices w = sphere.v;
  Vertices change(x.size());
  rbc::viscous_forces_change(sphere.shape, thinning, sphere.all, x, v.data(), false, w, change);
  double error[2];
  for (int n : {0, 1}) {
    const double step = 0.01 / (1 + n);
    sphere.power(thinning, one + step * two);
    Vertices difference = sphere.f;
    sphere.power(thinning, one - step * two);
    for (std::size_t i = 0; i < x.size(); ++i)
      difference[i] = (difference[i] - sphere.f[i]) / (2 * step);
    error[n] = test::largest_difference(difference, change);
  }
  EXPECT_NEAR(test::order(error[0], error[1]), 2, 0.05);
  EXPECT_LT(error[1], 1e-4 * test::total_norm(change) / change.size());
}

/// What Newton's method and the one with frozen viscosities solve for.
TEST(ThinningViscosity, FrozenChangeByTheVelocitiesIsAllOfTheForces)
{
  Sphere sphere(3);
  Matrix3 gradient;
  gradient << 1, 2, -3, 0.5, -2, 1, 0.2, 3, 1;
  sphere.power(thinning, gradient);
  Vertices change(sphere.f.size());
  rbc::viscous_forces_change(sphere.shape, thinning, sphere.all, sphere.shape.vertices,
                             sphere.v.data(), true, sphere.v, change);
  EXPECT_LT(test::largest_difference(change, sphere.f), 1e-13);
}

}    // namespace
