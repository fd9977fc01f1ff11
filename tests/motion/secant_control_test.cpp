#include "secant_control.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(SecantControl, FindsTheInputOfALinearSystem)
{
  for (const double guess : {0.1, 1.0, 5.0})
    for (const double offset : {0.0, -0.2}) {
      const auto system = [&](double input) { return 3 * input + offset; };
      rbc::SecantControl control;
      control.start(2 / guess, guess);
      for (int step = 0; step < 3; ++step) control.adjust(system(control.input()), 2);
      EXPECT_NEAR(system(control.input()), 2, 1e-12);
    }
}

TEST(SecantControl, FollowsAWantedValueThatChanges)
{
  rbc::SecantControl control;
  control.start(1, 1);
  const auto system = [](double input) { return 0.4 * input; };
  double wanted = 1;
  for (int step = 0; step < 200; ++step) {
    control.adjust(system(control.input()), wanted = std::cos(0.1 * step));
    EXPECT_NEAR(system(control.input()), wanted, step > 1 ? 1e-12 : 2);
  }
}

/// One that is disturbed from step to step is off by what changed since.
TEST(SecantControl, FollowsASlowDisturbance)
{
  rbc::SecantControl control;
  control.start(1, 1);
  double worst = 0;
  for (int step = 0; step < 500; ++step) {
    const double value = 0.4 * control.input() + 0.3 * std::sin(0.02 * step);
    if (step > 3) worst = std::max(worst, std::abs(value - 1));
    control.adjust(value, 1);
  }
  EXPECT_LT(worst, 1.05 * 0.3 * 0.02);
}

}    // namespace
