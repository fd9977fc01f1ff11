#include "contact/held_positions.h"
#include "contact/near_triangles.h"

#include "../geometry/test_support.h"

#include <optional>

using rbc::NearTriangles;
using test::Vec3;

namespace {

constexpr double range = 0.25, slack = 0.1, travel = 0.4;

/// Several cells side by side, so close that they overlap a little, as one array of points.
class Cells {
 public:
  explicit Cells(unsigned seed)
  {
    test::Random random(seed);
    const std::vector<test::Mesh> meshes = {test::icosphere(4), test::disc(5),
                                            test::cuboid({1.1, 0.9, 0.8}, 4), test::disc(3)};
    const Vec3 places[] = {{0, 0, 0}, {1.7, 0.3, 0.2}, {-0.5, 0.75, -0.4}, {0.3, -0.4, 1.15}};
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const test::Vertices shape = test::waved(meshes[m].vertices, seed + m);
      for (const auto &t : meshes[m].triangles)
        triangles.push_back(
            {{t[0] + size(), t[1] + size(), t[2] + size()}, NearTriangles::Surface(m + 7)});
      const auto rotation = random.rotation();
      for (const Vec3 &v : shape) x.push_back(rotation * v + places[m]);
      surfaces.resize(x.size(), m + 7);
    }
  }

  int size() const { return static_cast<int>(x.size()); }
  const double *data() const { return x[0].data(); }

  void move(double distance, unsigned seed)
  {
    test::Random random(seed);
    for (Vec3 &v : x) v += distance * random.direction();
  }

  /// Signed distance of a point to a surface, if below range.
  std::optional<double> gap(int point, NearTriangles::Surface surface) const
  {
    double nearest = HUGE_VAL, turns = 0;
    for (const auto &t : triangles) {
      if (t.surface != surface) continue;
      const Vec3 &a = x[t.corner[0]], &b = x[t.corner[1]], &c = x[t.corner[2]];
      nearest = std::min(nearest, (x[point] - test::closest_point(x[point], a, b, c)).norm());
      turns += test::winding(x[point], a, b, c);
    }
    if (nearest >= range) return {};
    return turns > 0.5 ? -nearest : nearest;
  }

  std::vector<Vec3> x;
  std::vector<NearTriangles::Surface> surfaces;
  std::vector<NearTriangles::Triangle> triangles;
};

using Gaps = std::map<std::pair<int, NearTriangles::Surface>, double>;

/// All points in range of a surface were found, with their signed distances. Returns how many are
/// inside of one and outside.
std::pair<int, int> expect_all_found(const Cells &cells, const Gaps &found)
{
  int inside = 0, outside = 0;
  for (int n = 0; n < cells.size(); ++n)
    for (NearTriangles::Surface surface = 7; surface < 11; ++surface) {
      if (surface == cells.surfaces[n]) continue;
      const auto gap = cells.gap(n, surface);
      const auto contact = found.find({n, surface});
      EXPECT_EQ(gap.has_value(), contact != found.end()) << n << " " << surface;
      if (!gap || contact == found.end()) continue;
      EXPECT_NEAR(*gap, contact->second, 1e-12) << n << " " << surface;
      ++(*gap < 0 ? inside : outside);
    }
  return {inside, outside};
}

/// Positions from which displacements count are held in single precision.
constexpr double held_to = 5e-6;

class Finder : public testing::TestWithParam<unsigned> {};

TEST_P(Finder, AgreesWithAllDistancesAndSolidAngles)
{
  Cells cells(GetParam());
  NearTriangles finder;
  finder.build(cells.size(), cells.surfaces.data(), cells.size(), cells.data(), cells.triangles,
               range, slack, travel);
  for (double moved : {0.0, 0.1 * slack, 0.28 * slack, 0.5 * slack}) {
    Cells there = cells;
    there.move(moved, 5);
    for (Vec3 &v : there.x) v += Vec3(0.05, -0.05, 0.03);
    const double approach = finder.largest_approach(there.data());
    EXPECT_LE(approach, 2 * std::sqrt(3.0) * moved + held_to)
        << "what moves them together counts not";
    EXPECT_GE(approach, 1.8 * moved);
    Gaps found;
    const auto &contacts = finder.contacts(there.data(), range);
    const double after = finder.largest_approach(there.data());
    if (approach > slack)
      EXPECT_LE(after, held_to) << "rebuilt";
    else
      EXPECT_EQ(after, approach);
    for (const auto &contact : contacts) {
      const auto surface = there.surfaces[contact.corner[0]];
      EXPECT_TRUE(found.emplace(std::make_pair(contact.point, surface), contact.gap).second);
      Vec3 p = Vec3::Zero();
      for (int c = 0; c < 3; ++c) p += contact.weight[c] * there.x[contact.corner[c]];
      const Vec3 normal(contact.normal.x, contact.normal.y, contact.normal.z);
      EXPECT_NEAR((there.x[contact.point] - p - contact.gap * normal).norm(), 0, 1e-12);
      EXPECT_NEAR(normal.norm(), 1, 1e-12);
    }
    const auto [inside, outside] = expect_all_found(there, found);
    EXPECT_GT(inside, 20);
    EXPECT_GT(outside, 50);
  }
}

TEST_P(Finder, KeepsItsListsInAFlow)
{
  // what a flow leaves is little: lists hold while it shears all by far more than they allow for
  const Cells cells(GetParam());
  NearTriangles finder;
  finder.build(cells.size(), cells.surfaces.data(), cells.size(), cells.data(), cells.triangles,
               range, slack, 10 * travel);
  test::Random random(GetParam());
  const Eigen::Matrix3d along = random.rotation() * Eigen::Vector3d(1, 0, 0) *
                                (random.rotation() * Eigen::Vector3d(0, 1, 0)).transpose();
  for (double strain : {0.05, 0.1, 0.2, 0.3}) {
    Cells there = cells;
    for (Vec3 &v : there.x) v += strain * along * v;
    there.move(0.05 * slack, 7);
    const double approach = finder.largest_approach(there.data());
    EXPECT_GE(approach, strain * range) << "two places may come nearer by that";
    if (strain < 0.15) {
      EXPECT_LE(approach, 2 * strain * range + 0.4 * slack);
      EXPECT_LE(approach, slack) << "not built anew";
    }
    Gaps found;
    for (const auto &contact : finder.contacts(there.data(), range))
      found[{contact.point, there.surfaces[contact.corner[0]]}] = contact.gap;
    const auto [inside, outside] = expect_all_found(there, found);
    EXPECT_GT(inside, 20);
    EXPECT_GT(outside, 50);
    finder.rebuild(cells.data());
  }
}

TEST_P(Finder, RebuiltForOtherPositions)
{
  Cells cells(GetParam());
  NearTriangles finder, anew;
  finder.build(cells.size(), cells.surfaces.data(), cells.size(), cells.data(), cells.triangles,
               range, slack, travel);
  cells.move(0.2, 8);
  finder.rebuild(cells.data());
  EXPECT_LE(finder.largest_approach(cells.data()), held_to);
  anew.build(cells.size(), cells.surfaces.data(), cells.size(), cells.data(), cells.triangles,
             range, slack, travel);
  const auto &found = finder.contacts(cells.data(), range);
  const auto &expected = anew.contacts(cells.data(), range);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t n = 0; n < found.size(); ++n) {
    EXPECT_EQ(found[n].point, expected[n].point);
    EXPECT_EQ(found[n].gap, expected[n].gap);
  }
}

TEST_P(Finder, SeesWhatItMayOfItsOwnSurface)
{
  Cells cells(GetParam());
  const auto far = [rest = cells](int point, int triangle) {
    for (int corner : rest.triangles[triangle].corner)
      if ((rest.x[corner] - rest.x[point]).norm() < 1.1 * range) return false;
    return true;
  };
  NearTriangles finder;
  finder.build(cells.size(), cells.surfaces.data(), cells.size(), cells.data(), cells.triangles,
               2 * range, slack, travel, far);
  for (bool rebuilt : {false, true}) {
    cells.move(0.28 * slack, 5);
    if (rebuilt) finder.rebuild(cells.data());
    std::map<int, double> found;
    for (const auto &contact : finder.contacts(cells.data(), 2 * range))
      if (cells.surfaces[contact.point] == cells.surfaces[contact.corner[0]]) {
        EXPECT_TRUE(found.emplace(contact.point, std::abs(contact.gap)).second);
      }
    for (int n = 0; n < cells.size(); ++n) {
      double nearest = HUGE_VAL;
      for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
        const auto &[corner, surface] = cells.triangles[t];
        if (surface == cells.surfaces[n] && far(n, static_cast<int>(t)))
          nearest = std::min(
              nearest, (cells.x[n] - test::closest_point(cells.x[n], cells.x[corner[0]],
                                                         cells.x[corner[1]], cells.x[corner[2]]))
                           .norm());
      }
      ASSERT_EQ(nearest < 2 * range, found.count(n) == 1) << n;
      if (nearest < 2 * range) {
        EXPECT_NEAR(found[n], nearest, 1e-12);
      }
    }
    EXPECT_GT(found.size(), 100u);
  }
}

// Most points have nothing near them, some only in a bin that shares no more than a corner with
// theirs.
TEST(Finder, SmallSurfacesFarApart)
{
  const test::Mesh mesh = test::icosphere(1);
  test::Random random(3);
  std::vector<Vec3> x;
  std::vector<NearTriangles::Triangle> triangles;
  std::vector<NearTriangles::Surface> surfaces;
  constexpr int count = 300;
  for (int m = 0; m < count; ++m) {
    const int first = static_cast<int>(x.size());
    const Vec3 place = 2.5 * (random.direction() + random.direction() + random.direction());
    for (const Vec3 &v : mesh.vertices) x.push_back(0.1 * v + place);
    for (const auto &t : mesh.triangles)
      triangles.push_back({{t[0] + first, t[1] + first, t[2] + first}, m - count / 2});
    surfaces.resize(x.size(), m - count / 2);
  }
  x.push_back(x[0] + Vec3(0.05, 0, 0));    // has no surface
  surfaces.push_back(NearTriangles::NO_SURFACE);
  const int size = static_cast<int>(x.size());
  NearTriangles finder;
  finder.build(size, surfaces.data(), size, x[0].data(), triangles, range, slack, travel);
  std::map<std::pair<int, NearTriangles::Surface>, double> found;
  for (const auto &contact : finder.contacts(x[0].data(), range))
    found[{contact.point, surfaces[contact.corner[0]]}] = std::abs(contact.gap);

  std::map<std::pair<int, NearTriangles::Surface>, double> expected;
  for (int n = 0; n < size - 1; ++n)
    for (const auto &[corner, surface] : triangles) {
      if (surface == surfaces[n] || (x[corner[0]] - x[n]).norm() > 1) continue;
      const double distance =
          (x[n] - test::closest_point(x[n], x[corner[0]], x[corner[1]], x[corner[2]])).norm();
      if (distance >= range) continue;
      double &nearest = expected.emplace(std::make_pair(n, surface), distance).first->second;
      nearest = std::min(nearest, distance);
    }
  ASSERT_GT(expected.size(), 100u);
  ASSERT_LT(expected.size(), x.size() / 2);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto &[pair, distance] : expected) EXPECT_NEAR(found[pair], distance, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Finder, testing::Values(1, 2, 3, 4, 5, 6));

// A vertex between two sheets of its own surface: it sees the outside of the one above, and the one
// below from within.
TEST(Finder, SideOfItsOwnSurfaceIsThatOfTheNearestSheet)
{
  std::vector<Vec3> x{{0, 0, 0},       {-1, -1, 0.1}, {0, 1, 0.1},   {1, -1, 0.1},
                      {-1, -1, -0.11}, {0, 1, -0.11}, {1, -1, -0.11}};
  const std::vector<NearTriangles::Triangle> triangles{{{1, 2, 3}, 1}, {{4, 5, 6}, 1}};
  const std::vector<NearTriangles::Surface> surfaces(x.size(), 1);
  NearTriangles finder;
  finder.build(1, surfaces.data(), static_cast<int>(x.size()), x[0].data(), triangles, range, slack,
               travel, [](int, int) { return true; });
  for (const auto &[height, gap] : {std::pair(0.0, 0.1), std::pair(-0.02, -0.09)}) {
    x[0][2] = height;
    const auto &contacts = finder.contacts(x[0].data(), range);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].gap, gap, 1e-15);
  }
}

TEST(Finder, PointOnTheSurface)
{
  test::Mesh mesh = test::icosphere(2);
  const int corners = static_cast<int>(mesh.vertices.size());
  std::vector<NearTriangles::Triangle> triangles;
  for (const auto &t : mesh.triangles) triangles.push_back({t, 1});
  const auto &first = mesh.triangles[0];
  mesh.vertices.push_back(
      (mesh.vertices[first[0]] + mesh.vertices[first[1]] + mesh.vertices[first[2]]) / 3);
  mesh.vertices.push_back(mesh.vertices[first[0]]);
  std::vector<NearTriangles::Surface> surfaces(corners, 1);
  surfaces.resize(corners + 2, 2);
  NearTriangles finder;
  finder.build(corners + 2, surfaces.data(), corners + 2, mesh.vertices[0].data(), triangles, range,
               0, 0);
  const auto &contacts = finder.contacts(mesh.vertices[0].data(), range);
  ASSERT_EQ(contacts.size(), 2u);
  for (const auto &contact : contacts) {
    EXPECT_NEAR(contact.gap, 0, 1e-15);
    const Vec3 normal(contact.normal.x, contact.normal.y, contact.normal.z);
    EXPECT_GT(std::abs(normal.dot(mesh.vertices[contact.point].normalized())), 0.99);
  }
}

/// Spheres in two distant groups, each of which moves as one, differ in motion only far from each
/// other.
TEST(RelativeMotion, CountsBetweenNeighborsOnly)
{
  test::Random random(3);
  std::vector<Vec3> x;
  for (int n = 0; n < 400; ++n) {
    const Vec3 place = random.vector(0, 4);
    x.push_back(n % 2 ? place : Vec3(place + Vec3(20, 0, 0)));
  }
  constexpr double near = 1.3;
  rbc::RelativeMotion motion;
  motion.hold(x[0].data(), static_cast<int>(x.size()), near);
  std::vector<Vec3> there = x;
  for (Vec3 &v : there) v += v[0] > 10 ? Vec3(3, 0, 0) : Vec3(0, -3, 0);
  constexpr double precision = 24e-6;    // a millionth of how far apart points are
  EXPECT_NEAR(motion.differences(there[0].data()).wider, 0, precision);

  for (Vec3 &v : there) v += 0.01 * v[2] * Vec3::UnitX() + 1e-3 * random.direction();
  double nearest = 0, wider = 0;
  std::vector<double> around(x.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = (x[i] - x[j]).norm();
      const double difference = (there[i] - x[i] - there[j] + x[j]).norm();
      if (apart < near) {
        nearest = std::max(nearest, difference);
        around[i] = std::max(around[i], difference);
        around[j] = std::max(around[j], difference);
      }
      if (apart < 2 * near) wider = std::max(wider, difference);
    }
  const auto bounds = motion.differences(there[0].data());
  EXPECT_GE(bounds.near, nearest);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_GE(motion.around(static_cast<int>(i)), around[i]) << i;
  EXPECT_LE(bounds.near, 0.01 * 3 * near + 4e-3) << "three bins";
  EXPECT_GE(bounds.wider, wider);
  EXPECT_LE(bounds.wider, 0.04 + 4e-3);

  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i][0] < 10) there[i] = x[i];
  motion.differences(there[0].data());
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_EQ(motion.around(static_cast<int>(i)) < precision, x[i][0] < 10)
        << "one group is at rest";

  there[7][1] = NAN;
  EXPECT_EQ(motion.differences(there[0].data()).near, HUGE_VAL);
}

TEST(HeldPositions, FurthestMoved)
{
  test::Mesh mesh = test::icosphere(2);
  rbc::HeldPositions held;
  EXPECT_EQ(held.furthest_moved(nullptr), -1);
  held.hold(mesh.vertices[0].data(), static_cast<int>(mesh.vertices.size()));
  EXPECT_EQ(held.largest_displacement(mesh.vertices[0].data()), 0);
  mesh.vertices[3][0] += 0.1;
  mesh.vertices[5][1] -= 0.2;
  EXPECT_EQ(held.furthest_moved(mesh.vertices[0].data()), 5);
  EXPECT_NEAR(held.largest_displacement(mesh.vertices[0].data()), 0.2, 2e-6);
}

TEST(Finder, NothingNear)
{
  NearTriangles finder;
  finder.build(0, nullptr, 0, nullptr, {}, range, slack, travel);
  EXPECT_EQ(finder.largest_approach(nullptr), 0);
  EXPECT_TRUE(finder.contacts(nullptr, range).empty());
}

}    // namespace
