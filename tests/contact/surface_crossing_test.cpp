#include "contact/surface_crossing.h"

#include "../geometry/test_support.h"

using rbc::MovingEdge;
using rbc::MovingPoint;
using rbc::MovingTriangle;
using test::Vec3;

namespace {

/// A point of a line from `start` to `end`, for the tests' own calculations.
struct Line {
  Vec3 start, end;

  Vec3 at(double t) const { return (1 - t) * start + t * end; }
  MovingPoint moving() const { return {test::plain(start), test::plain(end)}; }
};

Line still(const Vec3 &x)
{
  return {x, x};
}

const Line A = still({0, 0, 0}), B = still({1, 0, 0}), C = still({0, 1, 0});

bool meets(const Line &p, const Line &a = A, const Line &b = B, const Line &c = C)
{
  return rbc::touch(p.moving(), MovingTriangle{a.moving(), b.moving(), c.moving()});
}

bool meets(const std::array<Line, 2> &e, const std::array<Line, 2> &f)
{
  return rbc::touch(MovingEdge{e[0].moving(), e[1].moving()},
                    MovingEdge{f[0].moving(), f[1].moving()});
}

/// The times at which four points are in a plane: roots of a cubic, found between its extrema. The
/// classical test (Provot, Collision and self-collision handling in cloth, 1997).
template <typename Visit> void for_each_coplanar(const std::array<Line, 4> &x, const Visit &visit)
{
  const auto volume = [&](double t) {
    const Vec3 o = x[0].at(t);
    return (x[1].at(t) - o).dot((x[2].at(t) - o).cross(x[3].at(t) - o));
  };
  const double f0 = volume(0), f1 = volume(1), f2 = volume(2), f3 = volume(3);
  const double c3 = (f3 - 3 * f2 + 3 * f1 - f0) / 6, c2 = (f2 - 2 * f1 + f0) / 2 - 3 * c3,
               c1 = f1 - f0 - c2 - c3;
  std::vector<double> ends{0, 1};
  const double root = std::sqrt(std::max(0.0, c2 * c2 - 3 * c3 * c1));
  for (double sign : {-1.0, 1.0}) {
    const double extremum = (-c2 + sign * root) / (3 * c3);
    if (extremum > 0 && extremum < 1) ends.push_back(extremum);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t n = 0; n + 1 < ends.size(); ++n) {
    double lo = ends[n], hi = ends[n + 1];
    const bool above = volume(lo) > 0;
    if (above == (volume(hi) > 0)) continue;
    for (int halved = 0; halved < 50; ++halved) {
      const double middle = (lo + hi) / 2;
      ((volume(middle) > 0) == above ? lo : hi) = middle;
    }
    visit((lo + hi) / 2);
  }
}

/// Least distance to the rim of what they touch, positive within: tells clear cases.
double depth_in_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const auto depth = [&](const Vec3 &from, const Vec3 &to) {
    return normal.dot((to - from).normalized().cross(p - from));
  };
  return std::min({depth(a, b), depth(b, c), depth(c, a)});
}

/// Two lines in a plane meet at a share s of ab and t of cd.
double depth_in_edges(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
{
  const Vec3 u = b - a, v = d - c, normal = u.cross(v);
  const double s = (c - a).cross(v).dot(normal) / normal.squaredNorm();
  const double t = (c - a).cross(u).dot(normal) / normal.squaredNorm();
  return std::min({s, 1 - s, t, 1 - t});
}

enum class Outcome { apart, touch, close };

template <typename Depth> Outcome outcome(const std::array<Line, 4> &x, const Depth &depth)
{
  Outcome found = Outcome::apart;
  for_each_coplanar(x, [&](double t) {
    const double in = depth(x[0].at(t), x[1].at(t), x[2].at(t), x[3].at(t));
    if (in > 1e-4) found = Outcome::touch;
    if (std::abs(in) <= 1e-4 && found == Outcome::apart) found = Outcome::close;
  });
  return found;
}

template <typename Meets, typename Depth>
void compare_random(double motion, const Meets &meet, const Depth &depth)
{
  test::Random random(11);
  int touched = 0, apart = 0;
  for (int n = 0; n < 10000; ++n) {
    std::array<Line, 4> x;
    const Vec3 together = random.vector(-1, 1);
    for (Line &line : x) {
      line.start = random.vector(-0.5, 0.5);
      line.end = line.start + motion * random.vector(-1, 1) + together;
    }
    const Outcome expected = outcome(x, depth);
    if (expected == Outcome::close) continue;
    const bool found = meet(x);
    EXPECT_EQ(found, expected == Outcome::touch) << n;
    ++(found ? touched : apart);
  }
  EXPECT_GT(touched, 100);
  EXPECT_GT(apart, 1000);
}

}    // namespace

TEST(Touch, VertexThroughFace)
{
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(meets({{0.2, 0.3, side}, {0.2, 0.3, -side}}));
    EXPECT_TRUE(meets({{0.2, 0.3, side}, {0.2, 0.3, 0}})) << "ends on it";
    EXPECT_FALSE(meets({{0.2, 0.3, side}, {0.2, 0.3, 1e-5 * side}})) << "ends before it";
    EXPECT_FALSE(meets({{0.7, 0.31, side}, {0.7, 0.31, -side}})) << "passes beside it";
    EXPECT_TRUE(meets({{0.7, 0.29, side}, {0.7, 0.29, -side}}));
  }
  const Vec3 far(1e3, -1e3, 1e3);    // carried along
  EXPECT_TRUE(meets({{0.2, 0.3, 1}, far + Vec3(0.2, 0.3, -1)}, {A.start, far + A.end},
                    {B.start, far + B.end}, {C.start, far + C.end}));
  EXPECT_FALSE(meets({{0.2, 0.3, 1}, far + Vec3(0.2, 0.3, 1e-5)}, {A.start, far + A.end},
                     {B.start, far + B.end}, {C.start, far + C.end}));
}

TEST(Touch, VertexThatTurnsWithAFace)
{
  // A triangle that turns about its edge sweeps over a point that rests. Of the two positions of
  // the triangle neither is near the point.
  const Line turning{{0, 1, 0}, {0, -0.2, 0.8}};
  EXPECT_TRUE(meets(still({0.3, 0.2, 0.3}), A, B, turning));
  EXPECT_FALSE(meets(still({0.3, 0.2, -0.3}), A, B, turning));
  EXPECT_FALSE(meets(still({0.3, 0.5, 0.6}), A, B, turning)) << "beyond its chord";
}

TEST(Touch, EdgeThroughEdge)
{
  const std::array<Line, 2> along{still({-1, 0, 0}), still({1, 0, 0})};
  const auto across = [](double x, double from, double to) {
    return std::array<Line, 2>{Line{{x, -1, from}, {x, -1, to}}, Line{{x, 1, from}, {x, 1, to}}};
  };
  EXPECT_TRUE(meets(along, across(0.3, 0.5, -0.5)));
  EXPECT_TRUE(meets(along, across(0.3, 0.5, 0)));
  EXPECT_FALSE(meets(along, across(0.3, 0.5, 1e-5)));
  EXPECT_FALSE(meets(along, across(1.001, 0.5, -0.5)));
  EXPECT_TRUE(meets(across(0.3, -0.5, 0.5), along));
}

TEST(Touch, Grazing)
{
  // past an edge and along a face, as near as round-off and a little above
  EXPECT_TRUE(meets({{-1, 0.5, 1e-12}, {1, 0.5, 1e-12}}));
  EXPECT_FALSE(meets({{-1, 0.5, 1e-5}, {1, 0.5, 1e-5}}));
  EXPECT_FALSE(meets({{-1, -1e-5, 0}, {2, -1e-5, 0}})) << "in the plane of the triangle";
  EXPECT_TRUE(meets({{-1, 0.2, 0}, {2, 0.2, 0}}));
  const std::array<Line, 2> along{still({-1, 0, 0}), still({1, 0, 0})};
  const auto parallel = [](double z) {
    return std::array<Line, 2>{Line{{-3, 0, z}, {1, 0, z}}, Line{{-2, 0, z}, {2, 0, z}}};
  };
  EXPECT_TRUE(meets(along, parallel(0)));
  EXPECT_FALSE(meets(along, parallel(1e-5)));
}

TEST(Touch, Degenerate)
{
  const Line p = still({0.5, 0, 0}), q = still({0.5, 0, 0.1});
  EXPECT_TRUE(meets(p)) << "touches at the start and stays";
  EXPECT_FALSE(meets(q)) << "nothing moves";
  const Line needle = still({0.7, 0, 0});    // a triangle without area, between A and B
  EXPECT_TRUE(meets({{0.5, 0.1, 0.1}, {0.5, -0.1, -0.1}}, A, B, needle));
  EXPECT_FALSE(meets({{0.5, 0.1, 0.1}, {0.5, -0.1, 0.1}}, A, B, needle));
  EXPECT_TRUE(meets({{0.5, 0.1, 0.1}, {-0.5, -0.1, -0.1}}, A, A, A)) << "a point";
  const std::array<Line, 2> dot{p, p}, along{still({-1, 0, 0}), still({1, 0, 0})};
  EXPECT_TRUE(meets(dot, along));
  EXPECT_FALSE(meets(std::array<Line, 2>{q, q}, along));
}

TEST(Touch, RandomVertexAndTriangleAsTheCubicSays)
{
  for (double motion : {0.3, 1.0})
    compare_random(
        motion, [](const auto &x) { return meets(x[0], x[1], x[2], x[3]); }, depth_in_triangle);
}

TEST(Touch, RandomEdgesAsTheCubicSays)
{
  for (double motion : {0.3, 1.0})
    compare_random(
        motion,
        [](const auto &x) {
          return meets(std::array<Line, 2>{x[0], x[1]}, std::array<Line, 2>{x[2], x[3]});
        },
        depth_in_edges);
}

TEST(Touch, NeverTunnelsInSmallSteps)
{
  // Of the many parts of a motion one says that they touch if and only if the whole does.
  test::Random random(3);
  for (int n = 0; n < 300; ++n) {
    std::array<Line, 3> first, second;
    for (auto *triangle : {&first, &second})
      for (Line &line : *triangle) {
        line.start =
            random.vector(-0.5, 0.5) + (triangle == &first ? Vec3(1.2, 0, 0) : Vec3::Zero());
        line.end = line.start + random.vector(-0.6, 0.6);
      }
    const auto moving = [](const std::array<Line, 3> &x, double from, double to) {
      MovingTriangle triangle;
      for (int c = 0; c < 3; ++c) triangle[c] = Line{x[c].at(from), x[c].at(to)}.moving();
      return triangle;
    };
    bool in_parts = false;
    constexpr int parts = 40;
    for (int part = 0; part < parts; ++part) {
      const double from = double(part) / parts, to = double(part + 1) / parts;
      in_parts = in_parts || rbc::touch(moving(first, from, to), moving(second, from, to));
    }
    EXPECT_EQ(rbc::touch(moving(first, 0, 1), moving(second, 0, 1)), in_parts) << n;
  }
}
