#include "contact/packed_distances.h"

#include "../geometry/test_support.h"

#include <cmath>
#include <limits>

using rbc::PackedDistances;

TEST(PackedDistances, AreWholePartsRoundedDown)
{
  for (const double largest : {0.7, 1.0 / 3, 1e-9, 255.0}) {
    PackedDistances distances;
    distances.clear(largest);
    EXPECT_EQ(distances.parts(0), 0);
    EXPECT_EQ(distances.parts(largest), PackedDistances::MOST);
    for (int count = 0; count < PackedDistances::MOST; ++count)
      for (const double rest : {0.001, 0.5, 0.999}) {
        const double distance = (count + rest) * largest / PackedDistances::MOST;
        EXPECT_EQ(distances.parts(distance), count);
        distances.push_back(distance);
        EXPECT_EQ(distances[3 * count + (rest > 0.1) + (rest > 0.9)], count);
      }
  }
}

TEST(PackedDistances, NeverHaveMorePartsThanLargerOnes)
{
  test::Random random(3);
  for (int n = 0; n < 100000; ++n) {
    PackedDistances distances;
    const double largest = random.between(0.1, 2);
    distances.clear(largest);
    // multiples of a part, with what rounding makes of them, are where it could go wrong
    const double near = static_cast<int>(random.between(0, 256)) * (largest / 255);
    const double distance = near * (1 + 1e-16 * random.between(-3, 3));
    const double further = std::nextafter(distance, 3);
    EXPECT_LE(distances.parts(distance), distances.parts(further));
    EXPECT_LE(distances.parts(distance), distances.parts(distance + random.between(0, 0.1)));
  }
}

TEST(PackedDistances, LeaveOutNothingThatIsNoDistance)
{
  PackedDistances distances;
  distances.clear(0.5);
  EXPECT_EQ(distances.parts(7), PackedDistances::MOST);
  EXPECT_EQ(distances.parts(std::numeric_limits<double>::infinity()), PackedDistances::MOST);
  EXPECT_EQ(distances.parts(std::numeric_limits<double>::quiet_NaN()), PackedDistances::MOST);
  EXPECT_EQ(distances.parts(-1e-20), 0);
  distances.clear(0);
  EXPECT_EQ(distances.parts(0), PackedDistances::MOST);
}
