#include "vessel/triangulated_solid.h"

#include "test_support.h"

using rbc::PackingBox;
using rbc::TriangulatedSolid;
using test::Triangle;
using test::Vec3;

namespace {

/// Not convex, with triangles of all shapes.
std::vector<Triangle> potato()
{
  test::Mesh mesh = test::icosphere(6);
  for (Vec3 &x : mesh.vertices)
    x = (1 + 0.4 * std::sin(3 * x[0] + 1) * std::cos(4 * x[1]) + 0.2 * x[2]) *
        x.cwiseProduct(Vec3(3, 1, 2));
  return test::triangles_of(mesh);
}

double winding(const Vec3 &x, const std::vector<Triangle> &triangles)
{
  double sum = 0;
  for (const auto &[a, b, c] : triangles) sum += test::winding(x, a, b, c);
  return sum;
}

Vec3 closest(const Vec3 &x, const std::vector<Triangle> &triangles)
{
  Vec3 best = Vec3::Constant(HUGE_VAL);
  for (const auto &[a, b, c] : triangles) {
    const Vec3 point = test::closest_point(x, a, b, c);
    if ((x - point).norm() < (x - best).norm()) best = point;
  }
  return best;
}

TEST(TriangulatedSolid, SideAndDistanceAreThoseOfAllTriangles)
{
  const std::vector<Triangle> triangles = potato();
  const TriangulatedSolid solid(triangles, test::open_space);
  test::Random random(3);
  int inside = 0;
  for (int n = 0; n < 4000; ++n) {
    const Vec3 x = random.vector(-4, 4);
    const bool in = winding(x, triangles) > 0.5;
    ASSERT_EQ(solid.contains(x), in) << x.transpose();
    inside += in;
    const double distance = (x - closest(x, triangles)).norm();
    for (const double cutoff : {0.3, 10.0}) {
      const auto nearest = solid.nearest(x, cutoff);
      ASSERT_EQ(nearest.has_value(), distance < cutoff);
      if (!nearest) continue;
      ASSERT_NEAR(nearest->distance, in ? -distance : distance, 1e-12);
      ASSERT_NEAR(nearest->from_surface.norm(), distance, 1e-12);
      ASSERT_NEAR(
          (x - nearest->from_surface - closest(x - nearest->from_surface, triangles)).norm(), 0,
          1e-12);
    }
  }
  EXPECT_GT(inside, 150);
}

std::string problem(const std::vector<Triangle> &triangles, const PackingBox &box)
{
  try {
    TriangulatedSolid solid(triangles, box);
  } catch (const std::invalid_argument &found) {
    return found.what();
  }
  return {};
}

constexpr int sides = 12;
const PackingBox along_x{Vec3(-2, -6, -5), Vec3(7, 11, 10), {true, false, true}};

/// Through the periodic faces, of long triangles that reach from one to the other, and of short
/// ones.
TEST(TriangulatedSolid, TubeGoesOnThroughPeriodicFaces)
{
  test::Random random(7);
  for (const int layers : {1, 2, 9}) {
    const TriangulatedSolid tube(test::prism(sides, 2, -2, 7, layers, 0.3, -0.2), along_x);
    EXPECT_TRUE(tube.periodic()[0]);
    EXPECT_FALSE(tube.periodic()[1] || tube.periodic()[2]);
    EXPECT_NEAR(tube.volume(), 7 * sides * 4 * std::tan(test::pi / sides), 1e-10);
    for (int n = 0; n < 4000; ++n) {
      Vec3 x = random.vector(-3, 3);
      if (n % 4 == 0) x[0] = n % 8 == 0 ? -2 : 5;
      if (n % 4 == 1) x[0] += 7 * random.below(4) - 14;
      const double distance = test::prism_distance(sides, 2, x[1] - 0.3, x[2] + 0.2);
      ASSERT_EQ(tube.contains(x), distance <= 0) << x.transpose();
      if (distance > 0) continue;
      const auto nearest = tube.nearest(x, 3);
      ASSERT_TRUE(nearest);
      ASSERT_NEAR(nearest->distance, distance, 1e-12);
      ASSERT_NEAR(nearest->from_surface[0], 0, 1e-12);
    }
  }
}

TEST(TriangulatedSolid, IsTheSameTurnedInsideOut)
{
  std::vector<Triangle> triangles = potato();
  const TriangulatedSolid solid(triangles, test::open_space);
  for (Triangle &triangle : triangles) std::swap(triangle[0], triangle[2]);
  const TriangulatedSolid turned(triangles, test::open_space);
  EXPECT_DOUBLE_EQ(turned.volume(), solid.volume());
  test::Random random(4);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 x = random.vector(-4, 4);
    ASSERT_EQ(turned.contains(x), solid.contains(x));
    ASSERT_NEAR(turned.nearest(x, 10)->distance, solid.nearest(x, 10)->distance, 1e-12);
  }
}

/// A surface, scaled and moved, or turned inside out.
std::vector<Triangle> placed(std::vector<Triangle> triangles, double scale, const Vec3 &place,
                             bool turned = false)
{
  for (Triangle &triangle : triangles) {
    for (Vec3 &x : triangle) x = place + scale * x;
    if (turned) std::swap(triangle[1], triangle[2]);
  }
  return triangles;
}

TEST(TriangulatedSolid, SurfacesThatAreNotJoined)
{
  const std::vector<Triangle> ball = test::triangles_of(test::icosphere(3));
  const Vec3 here = Vec3::Zero(), beside(9, 1, 0), within(0.5, 0, 0);
  const auto together = [&](std::initializer_list<std::vector<Triangle>> parts) {
    std::vector<Triangle> all;
    for (const auto &part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  };
  const auto large = placed(ball, 4, here), cavity = placed(ball, 2, within, true),
             core = placed(ball, 1, within);
  for (const auto &good : {together({large, placed(ball, 2, beside)}), together({large, cavity}),
                           together({large, cavity, core, placed(ball, 1, beside)})}) {
    ASSERT_EQ(problem(good, test::open_space), "");
    const TriangulatedSolid solid(good, test::open_space);
    test::Random random(7);
    for (int n = 0; n < 500; ++n) {
      const Vec3 x = random.vector(-5, 12);
      ASSERT_EQ(solid.contains(x), winding(x, good) > 0.5) << x.transpose();
    }
  }
  const std::string turned = "oriented the other way than the rest", alike = "is oriented alike";
  for (const auto &[bad, said] :
       {std::pair(together({large, placed(ball, 2, beside, true)}), turned),
        std::pair(together({placed(ball, 4, here, true), placed(ball, 2, beside)}), turned),
        std::pair(together({large, core}), alike),
        std::pair(together({large, cavity, placed(ball, 1, within, true)}), turned)})
    EXPECT_NE(problem(bad, test::open_space).find(said), std::string::npos)
        << problem(bad, test::open_space);
}

TEST(TriangulatedSolid, SaysWhatIsWrong)
{
  const auto expect = [](const std::string &said, const std::string &part) {
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  const std::vector<Triangle> good = potato();
  EXPECT_EQ(problem(good, test::open_space), "");
  std::vector<Triangle> bad = good;
  bad.pop_back();
  expect(problem(bad, test::open_space), "belongs to one triangle only");
  bad = good;
  std::swap(bad[5][0], bad[5][1]);
  expect(problem(bad, test::open_space), "not oriented alike");
  bad = good;
  bad.push_back(good[7]);
  expect(problem(bad, test::open_space), "more than two triangles");

  const std::vector<Triangle> tube = test::prism(sides, 2, -2, 7, 3, 0, 0);
  EXPECT_EQ(problem(tube, along_x), "");
  expect(problem(tube, test::open_space), "belongs to one triangle only");
  PackingBox box = along_x;
  box.periodic[0] = false;
  expect(problem(tube, box), "belongs to one triangle only");
  std::vector<Triangle> sheared = tube;
  for (Triangle &triangle : sheared)
    for (Vec3 &corner : triangle) corner[1] += 0.1 * corner[0];
  expect(problem(sheared, along_x), "has no counterpart there");
  box = along_x;
  box.length[0] = 7.1;
  expect(problem(tube, box), "belongs to one triangle only");

  for (const double far : {1e150, 1e200}) {    // its square is a number, and is not
    bad = good;
    bad[3][0][1] = far;
    expect(problem(bad, test::open_space), "too far apart");
  }
  bad.assign(4, {Vec3::Ones(), Vec3::Ones(), Vec3::Ones()});
  expect(problem(bad, test::open_space), "no triangle has an area");
}

}    // namespace
