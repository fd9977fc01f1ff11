#include "motion/chebyshev.h"

#include "test_motion.h"

#include <gtest/gtest.h>

#include <random>

using rbc::ChebyshevMethod;
using rbc::DisplacementHistory;
using rbc::Numbers;

namespace {

/// A slow rotation that two fast modes of rates `fast` and `fast`/5 follow: x2 -> x0^2, x3 ->
/// sin(x1). Exact: a circle.
test::GivenMotion slow_and_fast(double fast)
{
  return test::GivenMotion([fast](const Numbers &x, double, Numbers &v) {
    v[0] = -x[1];
    v[1] = x[0];
    v[2] = -fast * (x[2] - x[0] * x[0]) - 2 * x[0] * x[1];
    v[3] = -fast / 5 * (x[3] - std::sin(x[1])) + std::cos(x[1]) * x[0];
    v[4] = v[5] = 0;
  });
}

Numbers exact(double t)
{
  const double x = std::cos(t), y = std::sin(t);
  return {x, y, x * x, std::sin(y), 0, 0};
}

/// Largest error at time 2 in `steps` steps, started from exact places.
double error_at_end(int order, double fast, int steps)
{
  const double end = 2, dt = end / steps;
  test::GivenMotion motion = slow_and_fast(fast);
  ChebyshevMethod method(order);
  method.set_stages(std::max(6, method.stages_for(fast * dt)));
  DisplacementHistory past;
  past.clear(method.past_steps());
  for (int n = method.past_steps(); n > 0; --n) {
    past.add(dt, test::difference(exact((1 - n) * dt), exact(-n * dt)));
  }
  Numbers x = exact(0), v(6), next;
  for (int n = 0; n < steps; ++n) {
    motion.velocity(x, 0, v);
    method.step(motion, dt, x, v, past, next);
    past.add(dt, test::difference(next, x));
    x = next;
  }
  return test::largest(test::difference(x, exact(end)));
}

class Order : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Chebyshev, Order, testing::Values(2, 3));

TEST_P(Order, IsThatOfTheMethod)
{
  const int order = GetParam();
  for (double fast : {1.0, 20.0}) {
    const double coarse = error_at_end(order, fast, 160), fine = error_at_end(order, fast, 320);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.15) << "fast mode " << fast;
  }
}

/// Fast modes relax to what moves them: the error is at least of second order, where a fast mode is
/// not resolved at all.
TEST_P(Order, HoldsForModesThatAreNotResolved)
{
  const int order = GetParam();
  for (double fast : {1e4, 1e6}) {
    const double coarse = error_at_end(order, fast, 40), fine = error_at_end(order, fast, 80);
    EXPECT_GT(std::log2(coarse / fine), order == 2 ? 1.9 : 2.8) << "fast mode " << fast;
    EXPECT_LT(fine, order == 2 ? 1e-3 : 3e-5);
  }
}

/// Growth in 100 steps of random perturbations of modes all over the real interval, `times` the
/// limit of stability.
double growth(int order, int stages, double times)
{
  const int modes = 300;
  ChebyshevMethod method(order);
  method.set_stages(stages);
  const double limit = times * method.stability_limit(stages);
  test::GivenMotion motion([&](const Numbers &x, double, Numbers &v) {
    for (int n = 0; n < modes; ++n) v[n] = -limit * (n + 1) / modes * x[n];
  });
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  DisplacementHistory past;
  past.clear(method.past_steps());
  Numbers x(modes), v(modes), next, moved(modes);
  for (double &value : x) value = uniform(random);
  for (int n = 0; n < method.past_steps(); ++n) {
    for (double &value : moved) value = uniform(random);
    past.add(1, moved);
  }
  for (int n = 0; n < 100 && test::largest(x) < 1e100; ++n) {
    motion.velocity(x, 0, v);
    method.step(motion, 1, x, v, past, next);
    past.add(1, test::difference(next, x));
    x = next;
  }
  return test::largest(x);
}

TEST(Chebyshev, IsStableUpToItsLimitAndNotBeyond)
{
  for (int order : {2, 3})
    for (int stages : {2, 3, 5, 10, 40, 200}) {
      EXPECT_LT(growth(order, stages, 0.999), 1) << order << " " << stages;
      EXPECT_GT(growth(order, stages, 1.2), 1) << order << " " << stages;
    }
}

TEST(Chebyshev, TakesAsFewStagesAsTheLimitAllows)
{
  for (int order : {2, 3}) {
    const ChebyshevMethod method(order);
    for (double stiffness : {0.0, 0.5, 3.0, 50.0, 1e4, 1e7}) {
      const int stages = method.stages_for(stiffness);
      EXPECT_GE(method.stability_limit(stages), stiffness);
      if (stages > ChebyshevMethod::LEAST_STAGES) {
        EXPECT_LT(method.stability_limit(stages - 1), stiffness);
      }
    }
  }
}

TEST(Chebyshev, EvaluatesOncePerStageButTheFirst)
{
  test::GivenMotion motion = slow_and_fast(1);
  ChebyshevMethod method;
  method.set_stages(7);
  Numbers x;
  method.step(motion, 0.1, exact(0), Numbers(6), DisplacementHistory(), x);
  EXPECT_EQ(motion.evaluations, 6);
}

/// What the motion is told of the time within a step: V = 3 t^2 is integrated with the order of the
/// method.
TEST(Chebyshev, TellsTheFractionOfTheStep)
{
  test::GivenMotion motion(
      [](const Numbers &, double fraction, Numbers &v) { v.assign(3, 2 * (0.5 + fraction)); });
  ChebyshevMethod method;
  method.set_stages(9);
  Numbers x;
  method.step(motion, 2, Numbers(3), Numbers(3, 1), DisplacementHistory(), x);
  EXPECT_NEAR(x[0], 4, 1e-12);    // 2 * integral of 1 + 2 f over f from 0 to 1
  method.step(motion, 1, Numbers(3), Numbers(3, 2), DisplacementHistory(), x, 0.5, 0.5);
  EXPECT_NEAR(x[0], 2.5, 1e-12);    // the second half
}

}    // namespace
