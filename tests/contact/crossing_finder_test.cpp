#include "contact/crossing_finder.h"
#include "geometry/triangle_distance.h"

#include "../geometry/test_support.h"

#include <set>

using rbc::CrossingFinder;
using test::Vec3;

namespace {

constexpr double MARGIN = 0.1, EDGE = 0.8;

/// Bodies side by side, apart by little, as one array of points.
class Bodies {
 public:
  explicit Bodies(unsigned seed)
  {
    test::Random random(seed);
    const Vec3 places[] = {{0, 0, 0}, {2.3, 0.1, 0.2}, {0.1, 2.3, -0.1}, {0.2, -0.3, 2.3}};
    for (std::size_t m = 0; m < std::size(places); ++m) {
      const test::Mesh mesh = test::icosphere(2);
      for (const auto &t : mesh.triangles)
        triangles.push_back(
            {{t[0] + size(), t[1] + size(), t[2] + size()}, CrossingFinder::Surface(m + 7)});
      const auto rotation = random.rotation();
      for (const Vec3 &v : test::waved(mesh.vertices, seed + m))
        x.push_back(rotation * v + places[m]);
    }
  }

  int size() const { return static_cast<int>(x.size()); }
  const double *data() const { return x[0].data(); }

  CrossingFinder::Scene scene(int owned) const
  {
    return {
        &triangles, size(), owned, MARGIN, 10, false, [](CrossingFinder::Pair) { return true; }};
  }

  rbc::Triangle corners(const CrossingFinder::Triangle &t) const
  {
    return {x[t.corner[0]], x[t.corner[1]], x[t.corner[2]]};
  }

  template <typename Visit> void for_each_pair(const Visit &visit) const
  {
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t j = i + 1; j < triangles.size(); ++j)
        if (triangles[i].surface != triangles[j].surface) visit(triangles[i], triangles[j]);
  }

  /// Moves each body as a rigid one, and its points a little more.
  void move(double distance, test::Random &random)
  {
    const std::size_t each = x.size() / 4;
    for (std::size_t body = 0; body < 4; ++body) {
      const Vec3 shift = distance * random.direction(), centre = x[body * each];
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(0.5 * distance, random.direction()).toRotationMatrix();
      for (std::size_t n = body * each; n < (body + 1) * each; ++n)
        x[n] = centre + turn * (x[n] - centre) + shift + 0.2 * distance * random.direction();
    }
  }

  std::vector<Vec3> x;
  std::vector<CrossingFinder::Triangle> triangles;
};

bool touch_on_the_way(const Bodies &from, const Bodies &to)
{
  bool found = false;
  from.for_each_pair([&](const auto &first, const auto &second) {
    const int i = first.corner[0], j = second.corner[0];
    constexpr double sizes = 4;    // of both, and of what they turn
    const Vec3 apart = from.x[i] - from.x[j], moved = to.x[i] - to.x[j] - apart;
    if (apart.norm() > sizes * EDGE + moved.norm()) return;
    rbc::MovingTriangle moving[2];
    for (int c = 0; c < 3; ++c) {
      moving[0][c] = {test::plain(from.x[first.corner[c]]), test::plain(to.x[first.corner[c]])};
      moving[1][c] = {test::plain(from.x[second.corner[c]]), test::plain(to.x[second.corner[c]])};
    }
    found = found || rbc::touch(moving[0], moving[1]);
  });
  return found;
}

bool intersect(const Bodies &bodies)
{
  bool found = false;
  bodies.for_each_pair([&](const auto &first, const auto &second) {
    found = found || rbc::distance(bodies.corners(first), bodies.corners(second)) == 0;
  });
  return found;
}

}    // namespace

class Crossing : public testing::TestWithParam<unsigned> {};

TEST_P(Crossing, FoundAsAmongAllPairs)
{
  // steps of all lengths against the margin; those that go wrong are taken again, shorter
  test::Random random(GetParam());
  Bodies now(GetParam());
  ASSERT_FALSE(intersect(now));
  CrossingFinder finder;
  finder.build(now.scene(now.size()));
  int wrong = 0, right = 0;
  for (int step = 0; step < 40; ++step) {
    finder.start(now.data());
    double distance = random.between(0.01, step % 4 == 0 ? 6 * MARGIN : 0.6 * MARGIN);
    for (;; distance *= 0.7) {
      Bodies next = now;
      next.move(distance, random);
      const Vec3 along = random.vector(-3, 3);    // all together
      for (Vec3 &v : next.x) v += along;
      const auto found = finder.find(next.data()).crossed;
      ASSERT_EQ(found.has_value(), touch_on_the_way(now, next)) << step;
      ++(found ? wrong : right);
      if (found) continue;
      now = next;
      break;
    }
    ASSERT_FALSE(intersect(now)) << step;
  }
  EXPECT_GT(wrong, 1);
  EXPECT_EQ(right, 40);
  EXPECT_LT(finder.counts().lists, finder.counts().steps);
}

TEST_P(Crossing, FoundWhereAllIsSheared)
{
  // the flow moves neighbors by more than the margin; what it leaves is little, now and then wrong
  test::Random random(GetParam());
  const Bodies first(GetParam());
  Bodies still = first, now = first;
  CrossingFinder finder;
  finder.build(now.scene(now.size()));
  const Eigen::Matrix3d rate = 0.02 * random.rotation() * Eigen::Vector3d(1, 0, 0) *
                               (random.rotation() * Eigen::Vector3d(0, 1, 0)).transpose();
  Eigen::Matrix3d flow = Eigen::Matrix3d::Identity();
  int wrong = 0;
  for (int step = 0; step < 24; ++step) {
    finder.start(now.data());
    flow += rate;
    for (double distance = step % 4 == 3 ? 7 * MARGIN : 0.02 * MARGIN;; distance *= 0.6) {
      Bodies left = still, next = still;
      left.move(distance, random);
      for (int n = 0; n < next.size(); ++n) next.x[n] = flow * left.x[n];
      const auto found = finder.find(next.data()).crossed;
      ASSERT_EQ(found.has_value(), touch_on_the_way(now, next)) << step;
      wrong += found.has_value();
      if (found) continue;
      still = left;
      now = next;
      break;
    }
  }
  EXPECT_GT(wrong, 0);
}

TEST_P(Crossing, ListsHoldInAFlow)
{
  const Bodies first(GetParam());
  Bodies now = first;
  CrossingFinder finder;
  finder.build(now.scene(now.size()));
  for (int step = 1; step <= 20; ++step) {
    finder.start(now.data());
    for (int n = 0; n < now.size(); ++n)
      now.x[n] = first.x[n] + 0.01 * step * Vec3(first.x[n][2], 0, 0.5 * first.x[n][1]);
    EXPECT_FALSE(finder.find(now.data()).crossed.has_value());
  }
  EXPECT_EQ(finder.counts().lists, 1) << "neighbors moved by several margins";
}

TEST_P(Crossing, FoundByOneOfSeveralRanks)
{
  // each rank owns the points of a part of space and numbers them first
  test::Random random(GetParam());
  const Bodies now(GetParam());
  for (int n = 0; n < 12; ++n) {
    Bodies next = now;
    next.move(random.between(0.5, 2.5) * MARGIN, random);
    int found = 0;
    for (int rank = 0; rank < 3; ++rank) {
      std::vector<int> order, place(now.size());
      const auto owner = [&](int i) { return now.x[i][0] < -0.2 ? 0 : now.x[i][0] < 0.4 ? 1 : 2; };
      for (bool own : {true, false})
        for (int i = 0; i < now.size(); ++i)
          if ((owner(i) == rank) == own) {
            place[i] = static_cast<int>(order.size());
            order.push_back(i);
          }
      Bodies here = now, there = next;
      int owned = 0;
      for (int i = 0; i < now.size(); ++i) {
        here.x[i] = now.x[order[i]];
        there.x[i] = next.x[order[i]];
        owned += owner(i) == rank;
      }
      for (auto &triangle : here.triangles)
        for (int &corner : triangle.corner) corner = place[corner];
      CrossingFinder finder;
      finder.build(here.scene(owned));
      finder.start(here.data());
      found += finder.find(there.data()).crossed.has_value();
    }
    EXPECT_EQ(found > 0, touch_on_the_way(now, next)) << n;
  }
}

TEST_P(Crossing, OfSurfacesAtRest)
{
  test::Random random(GetParam());
  Bodies bodies(GetParam());
  CrossingFinder finder;
  finder.build(bodies.scene(bodies.size()));
  EXPECT_TRUE(finder.crossed(bodies.data()).empty());
  for (int n = 0; n < 10; ++n) {
    Bodies moved = bodies;
    moved.move(random.between(0, 6) * MARGIN, random);
    EXPECT_EQ(!finder.crossed(moved.data()).empty(), intersect(moved)) << n;
  }
}

TEST_P(Crossing, OnlyOfPairsThatAreTested)
{
  const Bodies now(GetParam());
  Bodies next = now;
  const int each = now.size() / 4;
  for (int n = 0; n < each; ++n) next.x[n] += Vec3(0.8, 0, 0);    // into the second
  for (const bool both : {true, false}) {
    CrossingFinder finder;
    CrossingFinder::Scene scene = now.scene(now.size());
    scene.tested = [&](CrossingFinder::Pair pair) {
      return both ||
             now.triangles[pair.first].surface + now.triangles[pair.second].surface != 7 + 8;
    };
    finder.build(scene);
    finder.start(now.data());
    EXPECT_EQ(finder.find(next.data()).crossed.has_value(), both);
  }
}

TEST_P(Crossing, OfASurfaceWithItself)
{
  // a tube, closed by its ends, that is pressed flat until its faces pass through each other
  test::Mesh tube = test::cuboid({3, 1, 0.4}, 4);
  std::vector<CrossingFinder::Triangle> triangles;
  for (const auto &t : tube.triangles) triangles.push_back({{t[0], t[1], t[2]}, 5});
  const test::Vertices pressed = test::transformed(
      tube.vertices, [](const Vec3 &v) { return Vec3(v[0], v[1], v[2] < 0.2 ? 0.3 : 0.1); });
  for (const bool own : {true, false}) {
    CrossingFinder finder;
    finder.build({&triangles, static_cast<int>(tube.vertices.size()),
                  static_cast<int>(tube.vertices.size()), MARGIN, 10, own,
                  [](CrossingFinder::Pair) { return true; }});
    finder.start(tube.vertices[0].data());
    EXPECT_EQ(finder.find(pressed[0].data()).crossed.has_value(), own);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Crossing, testing::Values(1u, 2u, 3u));
