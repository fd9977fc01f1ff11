#include "vessel/surface_sampling.h"

#include "test_support.h"

#include <functional>

using rbc::Enclosure;
using rbc::PackingBox;
using rbc::SurfaceSampling;
using test::Vec3;

namespace {

/// Where a signed distance, or a function like it, is negative.
class Shape : public Enclosure {
 public:
  using Function = std::function<double(const Vec3 &)>;
  explicit Shape(Function function) : function_(std::move(function)) {}

  bool contains(const Vec3 &x) const override { return function_(x) <= 0; }
  Vec3 inward(const Vec3 &x, double) const override
  {
    constexpr double h = 1e-5;
    Vec3 gradient;
    for (int d = 0; d < 3; ++d)
      gradient[d] = function_(x + h * Vec3::Unit(d)) - function_(x - h * Vec3::Unit(d));
    return -gradient.normalized();
  }

 private:
  Function function_;
};

const PackingBox box{Vec3(0, 0, 0), Vec3(30, 20, 20), {true, false, true}};
const Vec3 hi = box.lo + box.length;

double square(double x)
{
  return x * x;
}

double tube(const Vec3 &x)
{
  return std::hypot(x[1] - 10, x[2] - 10) - 7;
}

/// A throat in the middle, of half the width.
double throat_radius(double x)
{
  return 5.25 + 1.75 * std::cos(2 * test::pi * x / 30);
}

double throat(const Vec3 &x)
{
  return std::hypot(x[1] - 10, x[2] - 10) - throat_radius(x[0]);
}

struct Case {
  const char *name;
  Shape::Function function;
  double area;
  double mean,
      least;    ///< distance of neighbors in spacings, at least; an edge disturbs the lattice
};

std::vector<Case> cases()
{
  double throat_area = 0;
  const int n = 10000;
  for (int i = 0; i < n; ++i) {
    const double x = 30.0 * (i + 0.5) / n,
                 slope = (throat_radius(x + 1e-4) - throat_radius(x - 1e-4)) / 2e-4;
    throat_area += 2 * test::pi * throat_radius(x) * std::hypot(1, slope) * 30 / n;
  }
  const auto sphere = [](const Vec3 &x) { return (x - Vec3(15, 10, 10)).norm() - 8; };
  const auto block = [](const Vec3 &x) {
    return ((x - Vec3(15, 10, 10)).cwiseAbs() - Vec3(10, 6, 7)).maxCoeff();
  };
  return {{"sphere", sphere, 4 * test::pi * 64, 0.91, 0.65},
          {"tube", tube, 2 * test::pi * 7 * 30, 0.91, 0.65},
          {"throat", throat, throat_area, 0.91, 0.65},
          {"block", block, 8 * (10 * 6 + 10 * 7 + 6 * 7), 0.87, 0.45}};
}

double periodic_distance(const Vec3 &a, const Vec3 &b)
{
  Vec3 arm = a - b;
  for (int d = 0; d < 3; ++d)
    if (box.periodic[d]) arm[d] -= box.length[d] * std::round(arm[d] / box.length[d]);
  return arm.norm();
}

/// Places of the surface, found along random lines.
std::vector<Vec3> places(const Shape::Function &function, int count)
{
  test::Random random(11);
  std::vector<Vec3> found;
  while (static_cast<int>(found.size()) < count) {
    Vec3 in = hi.cwiseProduct(random.vector(0, 1)), out = in + random.direction();
    if (function(in) > 0 || function(out) <= 0) continue;
    if (out[0] < 0 || out[0] > 30) continue;
    for (int n = 0; n < 40; ++n) {
      const Vec3 middle = (in + out) / 2;
      (function(middle) <= 0 ? in : out) = middle;
    }
    found.push_back(in);
  }
  return found;
}

TEST(SurfaceSampling, CoversTheSurfaceEvenly)
{
  for (const Case &c : cases())
    for (const double spacing : {0.7, 1.1}) {
      SCOPED_TRACE(c.name);
      const SurfaceSampling surface(Shape(c.function), box, box.lo, hi, spacing);
      const auto &points = surface.points();
      const double lattice = c.area / (std::sqrt(3) / 2 * square(spacing));
      EXPECT_NEAR(surface.area() / c.area, 1, 0.01);
      EXPECT_NEAR(points.size() / lattice, 1, 0.02);

      double mean = 0, squares = 0, least = HUGE_VAL;
      for (std::size_t n = 0; n < points.size(); ++n) {
        ASSERT_NEAR(c.function(points[n]), 0, 1e-8);
        double nearest = HUGE_VAL;
        for (std::size_t m = 0; m < points.size(); ++m)
          if (m != n) nearest = std::min(nearest, periodic_distance(points[n], points[m]));
        mean += nearest / points.size();
        squares += square(nearest) / points.size();
        least = std::min(least, nearest);
      }
      EXPECT_GT(mean, c.mean * spacing);
      EXPECT_LT(mean, spacing);
      EXPECT_LT(std::sqrt(squares - square(mean)), 0.09 * spacing);
      EXPECT_GT(least, c.least * spacing);
      EXPECT_NEAR(surface.mean_distance(), mean, 1e-10);
      EXPECT_NEAR(surface.least_distance(), least, 1e-10);

      double hole = 0;
      for (const Vec3 &place : places(c.function, 4000)) {
        double nearest = HUGE_VAL;
        for (const Vec3 &point : points)
          nearest = std::min(nearest, periodic_distance(place, point));
        hole = std::max(hole, nearest);
      }
      EXPECT_LT(hole, 0.95 * spacing);
      EXPECT_LT(hole, surface.largest_hole() + 0.1 * spacing);
    }
}

/// A thin wall has points on both sides, each as dense as those of one surface.
TEST(SurfaceSampling, SidesOfAThinWallDoNotSeeEachOther)
{
  const auto plate = [](const Vec3 &x) {
    return ((x - Vec3(15, 10, 10)).cwiseAbs() - Vec3(8, 0.3, 8)).maxCoeff();
  };
  const SurfaceSampling surface(Shape(plate), box, box.lo, hi, 1.0);
  const double sides = 4 * (8 * 8 + 8 * 0.3 + 8 * 0.3) * 2;
  EXPECT_NEAR(surface.points().size() / (sides / (std::sqrt(3) / 2)), 1, 0.1);
}

TEST(SurfaceSampling, StaysOffWalls)
{
  PackingBox walled = box;
  walled.periodic = {true, true, false};
  const auto post = [](const Vec3 &x) { return std::hypot(x[0] - 15, x[1] - 10) - 5; };
  const SurfaceSampling surface(Shape(post), walled, box.lo, hi, 1.0);
  double lowest = HUGE_VAL;
  for (const Vec3 &point : surface.points()) lowest = std::min(lowest, point[2]);
  EXPECT_NEAR(lowest, 0.25, 1e-9);
}

TEST(SurfaceSampling, FindsNothingWhereThereIsNoSurface)
{
  const SurfaceSampling surface(Shape([](const Vec3 &) { return -1.0; }), box, box.lo, hi, 1.0);
  EXPECT_TRUE(surface.points().empty());
}

}    // namespace
