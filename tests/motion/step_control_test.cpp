#include "motion/step_control.h"

#include "test_motion.h"

#include <gtest/gtest.h>

using rbc::Numbers;
using rbc::StepControl;

namespace {

/// For a point on t^3 it is 0.4 dt^3 whatever the method; zero for one on a parabola.
TEST(StepControl, MeasuresTheThirdDerivative)
{
  test::GivenMotion none([](const Numbers &, double, Numbers &) {});
  for (double dt : {0.1, 0.2}) {
    EXPECT_NEAR(StepControl::error(none, dt, {0, 0, 0}, {dt * dt * dt, 0, 0}, {0, 0, 0},
                                   {3 * dt * dt, 0, 0}),
                0.4 * dt * dt * dt, 1e-16);
    EXPECT_NEAR(StepControl::error(none, dt, {0, 0, 0}, {dt * dt, 0, 0}, {0, 0, 0}, {2 * dt, 0, 0}),
                0, 1e-16);
  }
}

TEST(StepControl, AimsBelowTheToleranceWithinBounds)
{
  StepControl control;
  control.tolerance = 1e-3;
  control.largest = 10;
  EXPECT_NEAR(control.next(1, 8e-3), 0.8 / 2, 1e-12);    // an error of third order, halved
  EXPECT_NEAR(control.next(1, 1e-3), 0.8, 1e-12);
  EXPECT_EQ(control.next(1, 1e-12), 2);
  EXPECT_EQ(control.next(1, 0), 2);
  EXPECT_EQ(control.next(8, 0), 10);
  EXPECT_NEAR(control.next(1, 1e9), 0.1, 1e-12);
  control.order = 1;
  EXPECT_NEAR(control.next(1, 4e-3), 0.8 / 2, 1e-12);
}

}    // namespace
