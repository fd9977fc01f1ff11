// Packing of rigid cells: its parts against closed forms and all pairs, the packings against all
// pairs of triangles.

#include "../geometry/test_support.h"
#include "geometry/point_bins.h"
#include "geometry/triangle_distance.h"
#include "packing/cell_packing.h"
#include "packing/fire.h"
#include "packing/surface_gap.h"

using namespace test;
using rbc::PackingBox;
using rbc::RigidCell;
using rbc::RigidShape;
using rbc::SurfaceTemplate;

namespace {

/// Cube of edge 2 about the origin.
SurfaceTemplate cube()
{
  Vertices corners;
  for (double z : {-1.0, 1.0})
    for (double y : {-1.0, 1.0})
      for (double x : {-1.0, 1.0}) corners.emplace_back(x, y, z);
  return {corners,
          {{0, 2, 3},
           {0, 3, 1},
           {4, 5, 7},
           {4, 7, 6},
           {0, 1, 5},
           {0, 5, 4},
           {2, 6, 7},
           {2, 7, 3},
           {0, 4, 6},
           {0, 6, 2},
           {1, 3, 7},
           {1, 7, 5}}};
}

double distance_from_cube(const Vec3 &x)
{
  const Vec3 beyond = x.cwiseAbs() - Vec3::Ones();
  return beyond.cwiseMax(0).norm() + std::min(0.0, beyond.maxCoeff());
}

RigidCell placed(const RigidShape &shape, const Vec3 &centre,
                 const Matrix3 &turn = Matrix3::Identity(), double size = 1)
{
  return {&shape, centre, turn, size};
}

Vec3 anywhere(const PackingBox &box, Random &random, double beyond = 0)
{
  Vec3 x;
  for (int d = 0; d < 3; ++d)
    x[d] = box.lo[d] + random.between(-beyond, 1 + beyond) * box.length[d];
  return x;
}

TEST(PointBins, FindAllImagesOfAllPoints)
{
  const PackingBox boxes[] = {{{0, 0, 0}, {1, 1, 1}, {true, true, true}},
                              {{-2, 5, 0.3}, {1, 0.7, 2.1}, {true, true, true}},
                              {{-2, 5, 0.3}, {1, 0.7, 2.1}, {true, false, true}},
                              {{3, -1, -1}, {1.3, 1, 0.9}, {false, false, false}}};
  Random random(12);
  for (const PackingBox &box : boxes)
    for (double width : {0.06, 0.24, 0.4, 0.5, 0.8, 1.1})
      for (double distance : {0.4 * width, width, 1.7 * width}) {
        rbc::PointBins bins(box, width);
        Vertices points;
        for (int n = 0; n < 30; ++n) {
          Vec3 x = anywhere(box, random);
          for (int d = 0; d < 3; ++d)
            if (box.periodic[d]) x[d] += box.length[d] * std::floor(random.between(-2, 3));
          points.push_back(x);
          bins.add(x);
        }
        const Vec3 from = anywhere(box, random);
        std::vector<double> expected, found;
        for (int n = 0; n < 30; ++n)
          for (int i = -6; i <= 6; ++i)
            for (int j = -6; j <= 6; ++j)
              for (int k = -6; k <= 6; ++k) {
                const Vec3 image(i, j, k);
                if ((i && !box.periodic[0]) || (j && !box.periodic[1]) || (k && !box.periodic[2]))
                  continue;
                const double r = (points[n] + image.cwiseProduct(box.length) - from).norm();
                if (r < distance) expected.push_back(n + r);
              }
        bins.visit(from, distance,
                   [&](int n, const Vec3 &image) { found.push_back(n + (image - from).norm()); });
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
      }
}

rbc::Triangle random_triangle(Random &random)
{
  rbc::Triangle triangle;
  for (Vec3 &corner : triangle)
    for (int d = 0; d < 3; ++d) corner[d] = random.between(-1, 1);
  return triangle;
}

/// By alternating projections onto the two convex sets, which end at a pair of closest points.
double distance_by_projections(const rbc::Triangle &first, const rbc::Triangle &second)
{
  const auto project = [](const Vec3 &p, const rbc::Triangle &triangle) {
    const auto w = rbc::closest_on_triangle(p, triangle);
    return Vec3(w[0] * triangle[0] + w[1] * triangle[1] + w[2] * triangle[2]);
  };
  Vec3 x = first[0], y;
  for (int n = 0; n < 20000; ++n) {
    y = project(x, second);
    x = project(y, first);
  }
  return (x - y).norm();
}

TEST(TriangleDistance, PointIsNoNearerToSamplesOfTheTriangle)
{
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    const rbc::Triangle triangle = random_triangle(random);
    const Vec3 p = 2 * random_triangle(random)[0];
    const double least = std::sqrt(rbc::squared_distance(p, triangle));
    double nearest = HUGE_VAL;
    const int cuts = 60;
    for (int i = 0; i <= cuts; ++i)
      for (int j = 0; i + j <= cuts; ++j) {
        const Vec3 x = triangle[0] + double(i) / cuts * (triangle[1] - triangle[0]) +
                       double(j) / cuts * (triangle[2] - triangle[0]);
        nearest = std::min(nearest, (p - x).norm());
      }
    EXPECT_LE(least, nearest + 1e-12);
    EXPECT_GE(least, nearest - 4.0 / cuts);
  }
}

TEST(TriangleDistance, AgreesWithAlternatingProjections)
{
  Random random(5);
  int apart = 0, cut = 0;
  for (int n = 0; n < 300; ++n) {
    const rbc::Triangle first = random_triangle(random), second = random_triangle(random);
    const double expected = distance_by_projections(first, second);
    const double found = rbc::distance(first, second);
    EXPECT_NEAR(found, expected, 1e-3);    // projections converge slowly where they nearly touch
    EXPECT_LE(found, expected + 1e-12);
    if (found > 0.05) {
      EXPECT_NEAR(found, expected, 1e-6);
    }
    ++(found > 0 ? apart : cut);
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(cut, 50);
}

TEST(DistanceField, OfACube)
{
  const SurfaceTemplate surface = cube();
  const rbc::DistanceField field(surface, 0.7);
  EXPECT_NEAR(field.depth(), 1, field.spacing());
  Random random(7);
  for (int n = 0; n < 20000; ++n) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = random.between(-1.7, 1.7);
    const auto [distance, gradient] = field.at(x);
    const double exact = distance_from_cube(x);
    // weights of the nodes times their distances from x
    EXPECT_NEAR(distance, exact, 0.87 * field.spacing());
    const Vec3 beyond = x.cwiseAbs() - Vec3::Ones();
    int axis;
    const double farthest = beyond.maxCoeff(&axis);
    const bool beside_face = farthest > 0.1 && (beyond.array() > -0.1).count() == 1;
    if (!beside_face) continue;
    EXPECT_NEAR(distance, exact, 1e-6);
    EXPECT_LT((gradient - std::copysign(1, x[axis]) * Vec3::Unit(axis)).norm(), 1e-5);
  }
  EXPECT_GE(field.at({0, 0, 4}).distance, 3 - 1e-6);
  EXPECT_NEAR(field.at({0, 0.2, 4}).gradient[2], 1, 1e-6);
}

TEST(DistanceField, TellsTheSidesOfADisc)
{
  const Mesh mesh = disc(8);
  const SurfaceTemplate surface = mesh.surface();
  const rbc::DistanceField field(surface, 0.3);
  const Profile profile;
  Random random(8);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 x(random.between(-1.2, 1.2), random.between(-1.2, 1.2), random.between(-0.6, 0.6));
    const double square = x[0] * x[0] + x[1] * x[1];
    const double half_thickness =
        square < 1 ? 0.5 * std::sqrt(1 - square) *
                         (profile.a0 + square * (profile.a1 + square * profile.a2))
                   : 0;
    const double below = half_thickness - std::abs(x[2]);
    if (std::abs(below) < 0.05 || (square > 0.8 && std::abs(x[2]) < 0.3)) continue;
    EXPECT_EQ(field.at(x).distance<0, below> 0) << x.transpose();
  }
}

TEST(SurfaceGap, OfCubes)
{
  const SurfaceTemplate surface = cube();
  const RigidShape shape(surface, 0.5);
  const Matrix3 on_edge = Eigen::AngleAxisd(pi / 4, Vec3::UnitX()).toRotationMatrix();
  const Matrix3 across = Eigen::AngleAxisd(pi / 4, Vec3::UnitY()).toRotationMatrix();
  const double root = std::sqrt(2.0);
  EXPECT_NEAR(surface_gap(placed(shape, {0, 0, 0}), placed(shape, {0.3, 0.4, 2.1}), 1), 0.1, 1e-12);
  EXPECT_NEAR(surface_gap(placed(shape, {0, 0, 0}, on_edge),
                          placed(shape, {0, 0, 2 * root + 0.1}, across), 1),
              0.1, 1e-12);
  EXPECT_NEAR(
      surface_gap(placed(shape, {0, 0, 0}), placed(shape, {0, 0, 2 + root / 2}, on_edge, 0.5), 1),
      1 + root / 2 - root / 2, 1e-12);
  EXPECT_EQ(surface_gap(placed(shape, {0, 0, 0}), placed(shape, {0, 0, 5}), 1), 1);
  EXPECT_EQ(surface_gap(placed(shape, {0, 0, 0}), placed(shape, {0.5, 0.6, 1.9}), 1), 0);
  EXPECT_EQ(surface_gap(placed(shape, {0, 0, 0}, on_edge),
                        placed(shape, {0, 0, 2 * root - 0.1}, across), 1),
            0);
  EXPECT_NEAR(surface_gap(Vec3(0.2, 0.3, 1.25), placed(shape, {0, 0, 0}), 1), 0.25, 1e-12);
  EXPECT_EQ(surface_gap(Vec3(0.2, 0.3, 0.25), placed(shape, {0, 0, 0}), 1), 0);
}

TEST(CellApproach, EdgesThatCrossAreSeen)
{
  // no corner of one is near the other
  const SurfaceTemplate surface = cube();
  const RigidShape shape(surface, 0.5);
  const double root = std::sqrt(2.0);
  const RigidCell lower =
      placed(shape, {0, 0, 0}, Eigen::AngleAxisd(pi / 4, Vec3::UnitX()).toRotationMatrix());
  const RigidCell upper = placed(shape, {0, 0, 2 * root - 0.1},
                                 Eigen::AngleAxisd(pi / 4, Vec3::UnitY()).toRotationMatrix());
  const rbc::CellApproach approach(upper, lower, 0.4);
  ASSERT_FALSE(approach.empty());
  rbc::Wrench push;
  approach.push(upper, lower, 0.05, push);
  // the edge is 0.1 below that of the other: 0.1 / sqrt 2 from its faces
  EXPECT_NEAR(push.overlap, 0.05 + 0.1 / root, shape.field.spacing());
  EXPECT_GT(push.force[2], 0);
  EXPECT_LT(std::abs(push.force[0]) + std::abs(push.torque[2]), 0.1 * push.force[2]);
}

TEST(Fire, ComesToRestInAQuadraticWell)
{
  const std::vector<double> stiffness{1, 10, 0.5};
  std::vector<double> x{1, -0.3, 2};
  rbc::Fire fire(3, 0.05, 0.3, 0.1);
  for (int step = 0; step < 2000; ++step) {
    std::vector<double> force;
    for (int i = 0; i < 3; ++i) force.push_back(-stiffness[i] * x[i]);
    if (force == std::vector<double>{0, 0, 0}) break;
    const std::vector<double> move = fire.move(force);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(std::abs(move[i]), 0.1 + 1e-15);
      x[i] += move[i];
    }
  }
  for (double coordinate : x) EXPECT_NEAR(coordinate, 0, 1e-8);
}

class Ball : public rbc::Enclosure {
 public:
  bool contains(const Vec3 &x) const override { return x.norm() <= radius; }
  Vec3 inward(const Vec3 &x, double) const override { return -x.normalized(); }

  double radius = 2.2;
};

TEST(Enclosure, ExcessBeyondABall)
{
  const Ball ball;
  EXPECT_EQ(ball.excess({0, 0, 0}, {1, 1, 1}).depth, 0);
  const auto straight = ball.excess({0.1, 0, 0}, {2.7, 0, 0});
  EXPECT_NEAR(straight.depth, 0.5, 2.6 / 4096);
  EXPECT_LT((straight.inward - Vec3(-1, 0, 0)).norm(), 1e-12);
}

/// Between all pairs of triangles of all pairs of images.
double least_gap(const PackingBox &box, const std::vector<RigidCell> &cells)
{
  const auto triangles_of = [](const RigidCell &cell) {
    std::vector<rbc::Triangle> triangles;
    for (const auto &[i, j, k] : cell.shape->surface.triangles)
      triangles.push_back({cell.vertex(i), cell.vertex(j), cell.vertex(k)});
    return triangles;
  };
  double least = HUGE_VAL;
  for (std::size_t a = 0; a < cells.size(); ++a) {
    const auto mine = triangles_of(cells[a]);
    for (std::size_t b = a + 1; b < cells.size(); ++b)
      for (int image = 0; image < 27; ++image) {
        RigidCell other = cells[b];
        const Vec3 apart = other.centre - cells[a].centre;
        bool real = true;
        for (int d = 0, n = image; d < 3; ++d, n /= 3) {
          real = real && (box.periodic[d] || n % 3 == 1);
          other.centre[d] +=
              box.length[d] *
              (n % 3 - 1 - (box.periodic[d] ? std::round(apart[d] / box.length[d]) : 0));
        }
        if (!real || (other.centre - cells[a].centre).norm() > 2.2) continue;
        for (const rbc::Triangle &theirs : triangles_of(other))
          for (const rbc::Triangle &triangle : mine)
            if ((triangle[0] - theirs[0]).norm() < 1)
              least = std::min(least, rbc::distance(triangle, theirs));
      }
  }
  return least;
}

void expect_packed(const PackingBox &box, const rbc::CellPacking &packing, double gap)
{
  EXPECT_EQ(packing.size(), 1);
  const double least = least_gap(box, packing.cells());
  EXPECT_GE(least, gap);
  EXPECT_LT(least, 2 * gap);    // the cells touch at such a density
  EXPECT_GE(packing.least_gap(), gap);
  EXPECT_LE(packing.least_gap(), least + 1e-12);
  for (const RigidCell &cell : packing.cells()) {
    EXPECT_LT((cell.rotation.transpose() * cell.rotation - Matrix3::Identity()).norm(), 1e-12);
    for (int v = 0; v < cell.shape->surface.vertex_count(); ++v)
      EXPECT_GE(box.clearance(cell.vertex(v)), gap / 2);
  }
}

TEST(CellPacking, HalfTheVolumeOfABoxIsDiscs)
{
  const SurfaceTemplate surface = disc(3).surface();
  const int count = 24;
  const double gap = 0.025, volume = count * surface.volume / 0.5;
  for (bool periodic : {true, false}) {
    const double height = periodic ? std::cbrt(volume) : 5.0;
    const double width = std::sqrt(volume / height);
    const PackingBox box{{-1, 2, 0.5}, {width, width, height}, {true, true, periodic}};
    rbc::CellPacking packing(box, {&surface}, std::vector<int>(count, 0), gap, 7);
    ASSERT_TRUE(packing.pack(5000));
    expect_packed(box, packing, gap);
  }
}

TEST(CellPacking, SaysHowDenselyDiscsFit)
{
  const SurfaceTemplate surface = disc(3).surface();
  const int count = 24;
  const double gap = 0.025, width = std::cbrt(count * surface.volume / 0.75);
  const PackingBox box{{0, 0, 0}, {width, width, width}, {true, true, true}};
  rbc::CellPacking packing(box, {&surface}, std::vector<int>(count, 0), gap, 7);
  EXPECT_FALSE(packing.pack(800));
  // denser than discs placed one after the other, less than the 0.74 of spheres on a lattice
  EXPECT_GT(0.75 * std::pow(packing.size(), 3), 0.45);
  EXPECT_LT(0.75 * std::pow(packing.size(), 3), 0.70);
  EXPECT_GE(least_gap(box, packing.cells()), gap * packing.size());
}

TEST(CellPacking, TwoKindsInABallKeepClearOfPoints)
{
  const SurfaceTemplate cell = disc(3).surface();
  Mesh small = icosphere(2);
  for (Vec3 &x : small.vertices) x *= 0.25;
  const SurfaceTemplate platelet = small.surface();
  std::vector<int> kinds(8, 0);
  kinds.insert(kinds.end(), 12, 1);
  const PackingBox box{{-3, -3, -3}, {6, 6, 6}, {true, true, true}};
  const Vertices points{{0, 0, 0}, {1, 0.5, -0.5}, {-1, -1, 0.2}};
  const Ball ball;
  const double gap = 0.03;
  rbc::CellPacking packing(box, {&cell, &platelet}, kinds, gap, 11);
  packing.confine(ball, box.lo, box.length);
  packing.avoid(points);
  ASSERT_TRUE(packing.pack(5000));
  EXPECT_GE(least_gap(box, packing.cells()), gap);
  for (const RigidCell &packed : packing.cells()) {
    for (int v = 0; v < packed.shape->surface.vertex_count(); ++v)
      EXPECT_TRUE(ball.contains(packed.vertex(v)));
    for (const Vec3 &point : points) EXPECT_GE(surface_gap(point, packed, 1), gap);
  }
}

}    // namespace
