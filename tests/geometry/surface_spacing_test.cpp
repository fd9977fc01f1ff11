#include "geometry/surface_spacing.h"

#include "test_support.h"

using rbc::PackingBox;
using rbc::SurfaceSpacing;
using test::Vec3;

namespace {

constexpr double reach = 6;
const PackingBox box{Vec3(-1, 2, 0), Vec3(24, 24, 24), {true, true, false}};

/// Points a x, b y apart in a plane, every second row shifted by `shift` along x; periodic in the
/// box.
std::vector<Vec3> lattice(double a, double b, double shift)
{
  std::vector<Vec3> points;
  for (int j = 0; j < std::lround(24 / b); ++j)
    for (int i = 0; i < std::lround(24 / a); ++i)
      points.emplace_back(-0.9 + a * i + (j % 2) * shift, 2.1 + b * j, 11);
  return points;
}

/// As ranks do it: each holds some of the points, and all pass by, in another order each time.
std::vector<double> spacings(const std::vector<Vec3> &points, int ranks)
{
  std::vector<double> found;
  for (int rank = 0; rank < ranks; ++rank) {
    std::vector<Vec3> mine;
    for (std::size_t n = rank; n < points.size(); n += ranks) mine.push_back(points[n]);
    SurfaceSpacing spacing(box, mine, reach);
    for (const Vec3 &x : points) spacing.offer_neighbor(x);
    for (auto x = points.rbegin(); x != points.rend(); ++x) spacing.offer_across(*x);
    for (int n = 0; n < spacing.points(); ++n) found.push_back(spacing.spacing(n));
  }
  return found;
}

void expect_all(const std::vector<Vec3> &points, double expected)
{
  for (int ranks : {1, 3})
    for (double spacing : spacings(points, ranks)) ASSERT_NEAR(spacing, expected, 1e-9);
}

TEST(SurfaceSpacing, OfLatticesIsTheirs)
{
  expect_all(lattice(3, 3, 0), 3);
  expect_all(lattice(2, 2 * 1.5, 1),
             std::sqrt(10));    // rows of close points, across 3 and along 1
  const double side = 24.0 / 14;
  expect_all(lattice(24.0 / 12, side, 1), std::hypot(1, side));    // triangles, nearly equilateral
}

TEST(SurfaceSpacing, OfLinesIsThatFromLineToLine)
{
  expect_all(lattice(0.5, 4, 0), 4);
  expect_all(lattice(0.5, 4, 0.25), std::hypot(4, 0.25));
}

TEST(SurfaceSpacing, OfAPointOrALineAlone)
{
  expect_all({Vec3(3, 3, 3)}, reach);
  expect_all({Vec3(3, 3, 3), Vec3(3, 3, 3)}, reach);    // one place
  expect_all({Vec3(3, 3, 3), Vec3(9.5, 3, 3)}, reach);
  expect_all(lattice(0.5, 24, 0), -1);
}

TEST(SurfaceSpacing, GoesThroughPeriodicSidesOnly)
{
  expect_all({Vec3(-0.5, 3, 3), Vec3(22.5, 3, 3), Vec3(-0.5, 25, 3), Vec3(22.5, 25, 3)}, 2);
  expect_all({Vec3(3, 3, 0.5), Vec3(3, 3, 23.5)}, reach);
}

}    // namespace
