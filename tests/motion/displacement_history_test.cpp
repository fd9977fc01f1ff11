#include "motion/displacement_history.h"

#include <gtest/gtest.h>

using rbc::DisplacementHistory;
using rbc::Numbers;

namespace {

/// One number that moves along t^power.
Numbers place(double t, int power)
{
  return {std::pow(t, power), 0, 0};
}

TEST(DisplacementHistory, ContinuesPolynomialsUpToItsLengthExactly)
{
  const double times[] = {-2.3, -1.9, -1.0, -0.4, 0.0};
  for (int length = 1; length <= DisplacementHistory::LONGEST; ++length)
    for (int power = 0; power <= length; ++power) {
      DisplacementHistory path;
      path.clear(length);
      for (int n = 1; n < 5; ++n)
        path.add(times[n] - times[n - 1],
                 {place(times[n], power)[0] - place(times[n - 1], power)[0], 0, 0});
      for (double t : {-0.7, 0.0, 0.35, 1.1}) {
        Numbers x = place(0, power), v(3);
        path.add_to(x, path.position_weights(t), 1);
        path.add_to(v, path.velocity_weights(t), 1);
        EXPECT_NEAR(x[0], place(t, power)[0], 1e-12) << length << " " << power << " " << t;
        EXPECT_NEAR(v[0], power == 0 ? 0 : power * std::pow(t, power - 1), 1e-11);
      }
    }
}

TEST(DisplacementHistory, KeepsTheLastSteps)
{
  DisplacementHistory path;
  path.clear(2);
  for (int n = 1; n <= 3; ++n) path.add(n, {10.0 * n, 0, 0});
  EXPECT_EQ(path.steps(), 2);
  for (auto [t, place] : {std::pair(-3.0, -30.0), std::pair(-5.0, -50.0)}) {
    Numbers x(3);
    path.add_to(x, path.position_weights(t), 1);
    EXPECT_NEAR(x[0], place, 1e-12);
  }
  path.clear(0);
  path.add(1, {1, 1, 1});
  EXPECT_EQ(path.steps(), 0);
}

}    // namespace
