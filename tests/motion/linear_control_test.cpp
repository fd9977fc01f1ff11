#include "motion/linear_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using rbc::LinearControl;
using Numbers = LinearControl::Numbers;

/// Three quantities, of which the first does not respond to the first input.
Numbers system(const Numbers &inputs, double offset = 0)
{
  const double response[3][3] = {{0, 2, -0.5}, {2, 5, 1}, {-0.5, 1, 3}};
  Numbers values;
  for (int i = 0; i < 3; ++i) {
    values.push_back(offset * (i + 1));
    for (int j = 0; j < 3; ++j) values[i] += response[i][j] * inputs[j];
  }
  return values;
}

TEST(LinearControl, IsRightAfterItsProbes)
{
  const Numbers wanted{3, -1, 0.5};
  for (const double size : {-0.1, 50.0}) {
    LinearControl control;
    control.probe(3, size);
    int solves = 0;
    for (; control.probing(); ++solves) control.adjust(system(control.inputs(), -20), wanted);
    EXPECT_EQ(solves, 4);
    const Numbers values = system(control.inputs(), -20);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(values[i], wanted[i], 1e-11);
    EXPECT_NEAR(control.effect(), 60.5, 1e-10);
  }
}

/// Off by the second difference of the disturbance, and not by wanted values that change.
TEST(LinearControl, FollowsADisturbance)
{
  LinearControl control;
  control.probe(3, 1);
  while (control.probing()) control.adjust(system(control.inputs()), {1, 2, 3});
  Numbers wanted{1, 2, 3};
  double worst = 0;
  for (int step = 0; step < 500; ++step) {
    const Numbers values = system(control.inputs(), std::sin(0.02 * step));
    for (int i = 0; i < 3 && step > 20; ++i)
      worst = std::max(worst, std::abs(values[i] - wanted[i]) / (i + 1));
    for (int i = 0; i < 3; ++i) wanted[i] = std::cos(0.5 * step + i);
    control.adjust(values, wanted);
  }
  EXPECT_LT(worst, 1.01 * 0.02 * 0.02);
  EXPECT_GT(worst, 0.9 * 0.02 * 0.02);
}

/// Of a resistance any flow takes work; the matrix of a rotation gives and takes none.
TEST(LinearControl, KnowsAResistance)
{
  const auto takes_work = [](double first, double second, double across, double back) {
    LinearControl control;
    control.probe(2, 0.5);
    while (control.probing()) {
      const Numbers &in = control.inputs();
      control.adjust({first * in[0] + across * in[1], back * in[0] + second * in[1]}, {1, 1});
    }
    return control.takes_work();
  };
  EXPECT_TRUE(takes_work(2, 3, 1, 1));
  EXPECT_TRUE(takes_work(2, 3, 2.4, 2.4));     // determinant 0.24
  EXPECT_FALSE(takes_work(2, 3, 2.5, 2.5));    // -0.25
  EXPECT_FALSE(takes_work(2, -3, 1, 1));
  EXPECT_FALSE(takes_work(-2, -3, 0, 0));
  EXPECT_TRUE(takes_work(1e-9, 1e-9, 1, -1));
  EXPECT_FALSE(takes_work(0, 0, 1, -1));
}

/// Where the disturbance stays, what it is asked for by a shift is there at once, and is kept.
TEST(LinearControl, IsShifted)
{
  LinearControl control;
  control.probe(3, 1);
  while (control.probing()) control.adjust(system(control.inputs(), 2), {1, 2, 3});
  control.shift({0.5, -4, 7});
  const Numbers wanted{1.5, -2, 10};
  for (int step = 0; step < 3; ++step) {
    const Numbers values = system(control.inputs(), 2);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(values[i], wanted[i], 1e-12);
    control.adjust(values, wanted);
  }
}

TEST(LinearControl, GoesOnFromItsState)
{
  LinearControl control, other;
  control.probe(3, 1);
  while (control.probing()) control.adjust(system(control.inputs()), {1, 2, 3});
  control.adjust(system(control.inputs(), 1), {1, 2, 3});
  EXPECT_FALSE(other.restore(2, control.state()));
  EXPECT_TRUE(other.restore(3, control.state()));
  EXPECT_FALSE(other.probing());
  for (int step = 0; step < 5; ++step) {
    EXPECT_EQ(other.inputs(), control.inputs());
    const Numbers values = system(control.inputs(), std::sin(step));
    control.adjust(values, {1, 2, 3});
    other.adjust(values, {1, 2, 3});
  }
}

}    // namespace
