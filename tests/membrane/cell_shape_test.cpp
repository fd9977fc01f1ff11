// Volume moments and the ellipsoid of inertia.

#include "membrane/cell_shape.h"
#include "test_support.h"

using namespace test;
using rbc::InertiaEllipsoid;
using rbc::VolumeMoments;

namespace {

VolumeMoments moments(const Mesh &mesh, const Matrix3 &map = Matrix3::Identity(),
                      const Vec3 &shift = Vec3::Zero())
{
  const Vertices x =
      transformed(mesh.vertices, [&](const Vec3 &v) { return Vec3(map * v + shift); });
  VolumeMoments sums;
  for (const auto &[i, j, k] : mesh.triangles) sums.add(x[i], x[j], x[k]);
  return sums;
}

TEST(CellShape, MomentsOfACuboid)
{
  const Vec3 size(1.5, 0.4, 2.5);
  const VolumeMoments sums = moments(cuboid(size, 2));
  EXPECT_NEAR(sums.area, 2 * (1.5 * 0.4 + 0.4 * 2.5 + 2.5 * 1.5), 5e-14);
  EXPECT_NEAR(sums.volume, 1.5, 1e-15);
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(sums.centre()[a], size[a] / 2, 1e-15);
    EXPECT_NEAR(sums.first[a], 1.5 * size[a] / 2, 1e-14);
    for (int b = 0; b < 3; ++b)
      EXPECT_NEAR(sums.second(a, b), 1.5 * size[a] * size[b] / (a == b ? 3 : 4), 1e-14);
  }
  const InertiaEllipsoid ellipsoid(sums);
  const Vec3 semi_axes = std::sqrt(5.0 / 12) * Vec3(2.5, 1.5, 0.4);
  EXPECT_LT((ellipsoid.semi_axes - semi_axes).norm(), 1e-14);
  EXPECT_NEAR(ellipsoid.deformation(), 2.1 / 2.9, 1e-14);
  EXPECT_LT((ellipsoid.long_axis - Vec3(0, 0, 1)).norm(), 1e-14);
  EXPECT_LT((ellipsoid.short_axis - Vec3(0, 1, 0)).norm(), 1e-14);
}

TEST(CellShape, MomentsFollowATranslation)
{
  Mesh mesh = disc(4);
  mesh.vertices = waved(mesh.vertices, 2);
  const VolumeMoments at_home = moments(mesh);
  const Vec3 shift(8, -5, 3);
  const VolumeMoments away = moments(mesh, Matrix3::Identity(), shift);
  EXPECT_NEAR(away.area, at_home.area, 1e-13);
  EXPECT_NEAR(away.volume, at_home.volume, 1e-12);
  EXPECT_LT((away.centre() - at_home.centre() - shift).norm(), 1e-12);
  const InertiaEllipsoid expected(at_home), found(away);
  EXPECT_LT((found.semi_axes - expected.semi_axes).norm(), 1e-10);
  EXPECT_LT((found.long_axis - expected.long_axis).norm(), 1e-10);
  EXPECT_LT((found.short_axis - expected.short_axis).norm(), 1e-10);
}

TEST(CellShape, AreaAndVolumeAreThoseOfTheTemplate)
{
  const Mesh mesh = disc(8);
  const rbc::SurfaceTemplate shape = mesh.surface();
  EXPECT_NEAR(moments(mesh).area, shape.area, 1e-12);
  EXPECT_NEAR(moments(mesh).volume, shape.volume, 1e-13);
}

TEST(CellShape, EllipsoidOfSecondOrder)
{
  Random random(6);
  for (const Vec3 &semi_axes : {Vec3(3, 2, 1), Vec3(1, 3, 2), Vec3(2, 2, 2)})
    for (int n = 0; n < 3; ++n) {
      const Matrix3 turn = random.rotation();
      const Vec3 shift = random.vector(-1, 1);
      Vec3 falling = semi_axes;
      std::sort(falling.data(), falling.data() + 3, std::greater<>());
      double last = 0;
      for (int frequency : {4, 8, 16}) {
        const InertiaEllipsoid found(
            moments(icosphere(frequency), turn * semi_axes.asDiagonal(), shift));
        const double error = (found.semi_axes - falling).norm();
        if (frequency > 4) {
          EXPECT_NEAR(order(last, error), 2, 0.05);
        }
        last = error;
        // The mesh has the symmetry of the icosahedron: its covariance is that of the ellipsoid but
        // for the size.
        EXPECT_NEAR(found.deformation(), (falling[0] - falling[2]) / (falling[0] + falling[2]),
                    1e-13);
        if (falling[0] == falling[2]) continue;
        int longest, shortest;
        semi_axes.maxCoeff(&longest);
        semi_axes.minCoeff(&shortest);
        EXPECT_NEAR(std::abs(found.long_axis.dot(turn.col(longest))), 1, 1e-14);
        EXPECT_NEAR(std::abs(found.short_axis.dot(turn.col(shortest))), 1, 1e-14);
      }
      EXPECT_LT(last, 0.03);
    }
}

TEST(CellShape, AxesPointTheWayOfTheirFirstComponent)
{
  const Mesh mesh = icosphere(3);
  for (double angle = 5; angle < 360; angle += 10) {
    const Matrix3 turn = Eigen::AngleAxisd(angle * pi / 180, Vec3::UnitY()).toRotationMatrix();
    const InertiaEllipsoid found(moments(mesh, turn * Vec3(3, 2, 1).asDiagonal()));
    EXPECT_GT(found.long_axis[0], 0);
    EXPECT_GT(found.short_axis[0], 0);
    EXPECT_NEAR(std::abs(found.long_axis[2] / found.long_axis[0]),
                std::abs(std::tan(angle * pi / 180)), 1e-10);
  }
}

}    // namespace
