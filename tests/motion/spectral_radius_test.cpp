#include "motion/spectral_radius.h"

#include "motion/chebyshev.h"
#include "test_motion.h"

#include <gtest/gtest.h>
#include <limits>

using rbc::Numbers;

namespace {

/// Rates evenly from `largest`/size to `largest`, in directions that a reflection mixes.
test::Matrix relaxation(int size, double largest)
{
  Numbers w(size);
  double square = 0;
  for (int i = 0; i < size; ++i) {
    w[i] = 1 + std::sin(3.0 * i);
    square += w[i] * w[i];
  }
  const auto reflection = [&](int i, int j) { return (i == j) - 2 * w[i] * w[j] / square; };
  test::Matrix matrix(size, Numbers(size));
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      for (int n = 0; n < size; ++n)
        matrix[i][j] -= largest * (n + 1) / size * reflection(i, n) * reflection(n, j);
  return matrix;
}

TEST(SpectralRadius, FindsTheLargestRate)
{
  for (double largest : {1e-3, 7.0, 1e6}) {
    test::GivenMotion motion = test::linear_motion(relaxation(30, largest));
    Numbers x(30, 1.0), v(30), mode(30, 0.3);
    mode[4] = -1;
    motion.velocity(x, 0, v);
    rbc::SpectralRadius spectrum;
    spectrum.tolerance = 1e-3;
    const double radius = spectrum.estimate(motion, x, v, 1e-4, mode);
    EXPECT_GT(radius, 0.97 * largest);
    EXPECT_LT(radius, (1 + 1e-6) * largest);

    // the mode is a good guess for the next estimate
    motion.evaluations = 0;
    spectrum.estimate(motion, x, v, 1e-4, mode);
    EXPECT_LE(motion.evaluations, 3);
  }
}

/// A guess with a millionth of the fastest mode, among many half as fast.
TEST(SpectralRadius, FindsAModeThatTheGuessHardlyHolds)
{
  test::GivenMotion motion([](const Numbers &x, double, Numbers &v) {
    for (std::size_t i = 0; i < x.size(); ++i) v[i] = (i == 0 ? -2 : -1) * x[i];
  });
  const Numbers x(30);
  Numbers v(30), mode(30, 1.0), again = mode;
  mode[0] = again[0] = 1e-6;
  rbc::SpectralRadius spectrum;
  EXPECT_NEAR(spectrum.estimate(motion, x, v, 1e-4, again), 1, 0.01);
  spectrum.min_iterations = 20;
  EXPECT_NEAR(spectrum.estimate(motion, x, v, 1e-4, mode), 2, 0.04);
}

/// A mode that has become the fastest since the last estimate, which goes on finding the one that
/// was.
TEST(SpectralRadius, FindsTheModeAlongWhichAnUnstableStepGrew)
{
  const double slow = 1, fast = 9;
  test::GivenMotion motion([&](const Numbers &x, double, Numbers &v) {
    for (std::size_t i = 0; i < x.size(); ++i) v[i] = (i == 7 ? -fast : -slow) * x[i];
  });
  Numbers start(30, 1.0), v(30), end, mode(30, 1.0);
  start[7] = 1e-3;    // hardly excited
  mode[7] = 0;
  motion.velocity(start, 0, v);
  rbc::SpectralRadius spectrum;
  const double before = spectrum.estimate(motion, start, v, 1e-4, mode);
  EXPECT_NEAR(before, slow, 1e-6);

  rbc::ChebyshevMethod method;
  const double dt = 10;
  method.set_stages(method.stages_for(dt * before));
  method.step(motion, dt, start, v, rbc::DisplacementHistory(), end);
  ASSERT_GT(std::abs(end[7]), 1);    // unstable
  // signs of modes mean nothing: what grew, the other way round, with a little of the slow ones
  Numbers opposite(30, 1e-3);
  const double time = rbc::dot(motion, test::difference(end, start), v) / rbc::dot(motion, v, v);
  for (std::size_t i = 0; i < v.size(); ++i) opposite[i] -= end[i] - start[i] - time * v[i];
  for (Numbers *guess : {&mode, &opposite}) {
    spectrum.suspect(motion, start, end, v, *guess);
    EXPECT_NEAR(spectrum.estimate(motion, start, v, 1e-4, *guess), fast, 0.02 * fast);
  }

  // nothing to learn from a step that did not move, or went to infinity
  const Numbers known = mode;
  spectrum.suspect(motion, start, start, v, mode);
  EXPECT_EQ(mode, known);
  end[3] = std::numeric_limits<double>::infinity();
  spectrum.suspect(motion, start, end, v, mode);
  EXPECT_EQ(mode, known);
}

TEST(SpectralRadius, IsZeroWhereNothingDependsOnPositions)
{
  test::GivenMotion motion([](const Numbers &, double, Numbers &v) { v.assign(3, 1.0); });
  Numbers mode(3, 1.0);
  EXPECT_EQ(rbc::SpectralRadius().estimate(motion, Numbers(3), Numbers(3, 1.0), 1e-4, mode), 0);
}

}    // namespace
