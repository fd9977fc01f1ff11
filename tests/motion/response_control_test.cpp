#include "motion/response_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using rbc::ResponseControl;

TEST(ResponseControl, IsRightAfterTwoProbes)
{
  for (const double probe : {-0.1, 1.0, 50.0})
    for (const double offset : {0.0, -20.0}) {
      const auto system = [&](double input) { return 3 * input + offset; };
      ResponseControl control;
      control.probe(probe);
      int solves = 0;
      for (; control.probing(); ++solves) control.adjust(system(control.input()), 2);
      EXPECT_EQ(solves, 2);
      EXPECT_NEAR(system(control.input()), 2, 1e-12);
    }
}

/// The wanted value is that of the next time.
TEST(ResponseControl, FollowsAWantedValueThatChanges)
{
  ResponseControl control;
  control.probe(1);
  const auto system = [](double input) { return 0.4 * input + 0.3; };
  while (control.probing()) control.adjust(system(control.input()), 1);
  for (int step = 0; step < 100; ++step) {
    const double wanted = std::cos(0.5 * step);
    control.adjust(system(control.input()), wanted);
    EXPECT_NEAR(system(control.input()), wanted, 1e-13);
  }
}

/// Where the disturbance stays, what it is asked for by a shift is there at once, and is kept.
TEST(ResponseControl, IsShifted)
{
  ResponseControl control;
  control.probe(1);
  const auto system = [](double input) { return 0.4 * input + 0.3; };
  while (control.probing()) control.adjust(system(control.input()), 1);
  control.shift(-3);
  for (int step = 0; step < 3; ++step) {
    EXPECT_NEAR(system(control.input()), -2, 1e-13);
    control.adjust(system(control.input()), -2);
  }
}

/// Off by the second difference of the disturbance; also where the response has changed since it
/// was measured.
TEST(ResponseControl, FollowsADisturbance)
{
  for (const double response : {0.4, 0.35, 0.45}) {
    ResponseControl control;
    control.probe(1);
    while (control.probing()) control.adjust(0.4 * control.input(), 1);
    double worst = 0;
    for (int step = 0; step < 500; ++step) {
      const double value = response * control.input() + 0.3 * std::sin(0.02 * step);
      if (step > 20) worst = std::max(worst, std::abs(value - 1));
      control.adjust(value, 1);
    }
    EXPECT_LT(worst, 1.1 * 0.3 * 0.02 * 0.02 * 0.4 / response);
  }
}

/// From what it knows another one gives the same inputs.
TEST(ResponseControl, GoesOnFromItsState)
{
  const auto system = [](double input, int step) { return 0.4 * input + 0.3 * std::sin(step); };
  ResponseControl control, other;
  control.probe(1);
  while (control.probing()) control.adjust(system(control.input(), 0), 1);
  for (int step = 1; step < 5; ++step) control.adjust(system(control.input(), step), 1);
  other.restore(control.state());
  EXPECT_FALSE(other.probing());
  for (int step = 5; step < 10; ++step) {
    EXPECT_EQ(other.input(), control.input());
    EXPECT_DOUBLE_EQ(other.effect(), 0.4 * other.input());
    const double value = system(control.input(), step);
    control.adjust(value, 1);
    other.adjust(value, 1);
  }
}

}    // namespace
