#include "contact/held_bodies.h"

#include "../geometry/test_support.h"

#include <algorithm>
#include <limits>

namespace {

/// Bodies of GROUP points each, of sizes from a thousandth to a thousand.
struct Bodies {
  std::vector<double> x;
  rbc::NumberLists lists;

  explicit Bodies(int count)
  {
    test::Random random(5);
    double size = 1e-3;
    for (int body = 0; body < count; ++body, size = size < 1e3 ? 2 * size : 1e-3) {
      const double centre[3] = {random.between(-50, 50), random.between(-50, 50), 1e3};
      for (int n = 0; n < rbc::GROUP; ++n) {
        lists.number.push_back(static_cast<int>(x.size() / 3));
        for (double c : centre) x.push_back(c + random.between(-size, size));
      }
      lists.begin.push_back(static_cast<int>(lists.number.size()));
    }
  }
};

}    // namespace

TEST(HeldBodies, KnowPointsToHalfA32767thOfTheRadius)
{
  const Bodies bodies(1000);
  rbc::HeldBodies held;
  held.hold(bodies.x.data(), bodies.lists);
  for (int body = 0; body < held.count(); ++body)
    for (int n = rbc::GROUP * body; n < rbc::GROUP * (body + 1); ++n) {
      const rbc::PlainVector off =
          rbc::at(bodies.x.data(), n) - held.centre(body) - held.offset(body, n);
      const double largest = std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
      EXPECT_LE(largest, held.error(body));
      EXPECT_LE(held.error(body), held.radius(body) / 64000);
      EXPECT_LE(rbc::norm(held.offset(body, n)), held.radius(body) * (1 + 2.0 / 32767));
    }
}

TEST(HeldBodies, AreWithinBoundsAlongLines)
{
  const Bodies bodies(1000);
  rbc::HeldBodies held;
  held.hold(bodies.x.data(), bodies.lists);
  test::Random random(6);
  for (int body = 0; body < held.count(); ++body)
    for (int number = 0; number < 20; ++number) {
      rbc::PlainVector line{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      if (number == 0) line = {1, 1, 1};    // errors of all three coordinates count most
      line = (1 / rbc::norm(line)) * line;
      double lowest = std::numeric_limits<double>::max(), highest = -lowest;
      for (int n = rbc::GROUP * body; n < rbc::GROUP * (body + 1); ++n) {
        const double along = rbc::dot(line, rbc::at(bodies.x.data(), n));
        lowest = std::min(lowest, along);
        highest = std::max(highest, along);
      }
      const rbc::Bounds bounds = held.along(body, line);
      const double rounding = 1e-12;    // of positions up to 1e3
      EXPECT_LE(bounds.lowest, lowest + rounding);
      EXPECT_GE(bounds.highest, highest - rounding);
      EXPECT_GE(bounds.lowest, lowest - 4 * held.error(body) - rounding);
      EXPECT_LE(bounds.highest, highest + 4 * held.error(body) + rounding);
    }
}

TEST(HeldBodies, MayBeSinglePoints)
{
  const std::vector<double> x{1, 2, 3};
  rbc::NumberLists lists;
  lists.number.assign(rbc::GROUP, 0);
  lists.begin.push_back(rbc::GROUP);
  rbc::HeldBodies held;
  held.hold(x.data(), lists);
  EXPECT_EQ(held.radius(0), 0);
  const rbc::Bounds bounds = held.along(0, {0, 0, 1});
  EXPECT_EQ(bounds.lowest, 3);
  EXPECT_EQ(bounds.highest, 3);
}
