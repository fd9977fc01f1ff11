#include "geometry/rounding.h"

#include "test_support.h"

TEST(Rounding, IsToTheNextNumberOnOneSide)
{
  test::Random random(8);
  for (int n = 0; n < 100000; ++n) {
    const double number = random.between(-1, 1) * std::pow(10, random.between(-30, 30));
    const float down = rbc::rounded_down(number), up = rbc::rounded_up(number);
    EXPECT_LE(down, number);
    EXPECT_GT(std::nextafter(down, HUGE_VALF), number);
    EXPECT_GE(up, number);
    EXPECT_LT(std::nextafter(up, -HUGE_VALF), number);
  }
}

TEST(Rounding, IsNotAboveAndNearTheNearest)
{
  test::Random random(9);
  const double part = std::numeric_limits<float>::epsilon(),
               least = std::numeric_limits<float>::min();
  for (int n = 0; n < 100000; ++n) {
    const double number = random.between(-1, 1) * std::pow(10, random.between(-60, 30));
    EXPECT_LE(rbc::not_above(number), number);
    EXPECT_GE(rbc::not_above(number), number - 2 * (part * std::abs(number) + least));
    const auto single = static_cast<float>(number);    // where rounding up begins
    EXPECT_LE(rbc::not_above(single), single);
  }
  EXPECT_LE(rbc::not_above(0), 0);
  EXPECT_GE(rbc::not_above(0), -2 * least);
}
