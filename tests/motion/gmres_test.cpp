#include "motion/gmres.h"

#include "test_motion.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using rbc::Gmres;
using rbc::KeptDirections;
using rbc::Numbers;

namespace {

class Equations : public testing::Test {
 protected:
  static constexpr int size = 30;

  Equations()
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) matrix[i][j] = uniform(random) + (i == j ? 4 : 0);
      solution[i] = uniform(random);
    }
  }

  test::Matrix matrix = test::Matrix(size, Numbers(size));
  Numbers solution = Numbers(size);
  test::GivenMotion motion{
      [this](const Numbers &x, double, Numbers &v) { v = test::product(matrix, x); }};
  Gmres::Operator apply = [this](const Numbers &p, Numbers &v) { motion.velocity(p, 0, v); };
  Gmres gmres;
};

TEST_F(Equations, AreSolvedToTheTolerance)
{
  Numbers y(size, 1.0), r = test::product(matrix, solution);
  EXPECT_LE(gmres.solve(apply, motion, r, 1e-12, y), 1e-12);
  for (double &value : y) value -= 1;
  EXPECT_LT(test::largest(test::difference(y, solution)), 1e-12);
  EXPECT_LE(gmres.iterations(), size);
  EXPECT_EQ(motion.evaluations, gmres.iterations());
}

TEST_F(Equations, EndAtTheLargestNumberOfIterationsWithTheResidualThere)
{
  const Numbers r = test::product(matrix, solution);
  Numbers y(size), overwritten = r;
  gmres.max_iterations = 4;
  const double residual = gmres.solve(apply, motion, overwritten, 1e-12, y);
  EXPECT_EQ(gmres.iterations(), 4);
  const Numbers left = test::difference(r, test::product(matrix, y));
  EXPECT_NEAR(residual, std::sqrt(dot(motion, left, left)), 1e-12);
}

TEST_F(Equations, WithNothingToDoCostNothing)
{
  Numbers y = solution, r(size);
  EXPECT_EQ(gmres.solve(apply, motion, r, 0.0, y), 0);
  EXPECT_EQ(y, solution);
  EXPECT_EQ(motion.evaluations, 0);
}

/// A bound that no one reaches must cost nothing.
TEST_F(Equations, TakeTheMemoryOfTheIterationsMade)
{
  gmres.max_iterations = std::numeric_limits<int>::max();
  Numbers y(size), r = test::product(matrix, solution);
  EXPECT_LE(gmres.solve(apply, motion, r, 1e-12, y), 1e-12);
  EXPECT_LT(test::largest(test::difference(y, solution)), 1e-12);
  const std::size_t vectors = gmres.iterations() + 1;
  EXPECT_LE(gmres.bytes(), 2 * vectors * (size + vectors) * sizeof(double));

  const std::size_t before = gmres.bytes();
  y.assign(size, 0.0);
  r = test::product(matrix, solution);
  gmres.solve(apply, motion, r, 1e-12, y);
  EXPECT_EQ(gmres.bytes(), before);
}

/// What was solved before is solved again in one iteration, as are sums of it.
TEST_F(Equations, AreSolvedAtOnceAlongKeptDirections)
{
  KeptDirections kept(2);
  Numbers other(size, 0.3);
  for (const Numbers &wanted : {solution, other}) {
    Numbers y(size), r = test::product(matrix, wanted);
    gmres.solve(apply, motion, r, 1e-12, y, &kept);
    EXPECT_LT(test::largest(test::difference(y, wanted)), 1e-12);
    EXPECT_GT(gmres.iterations(), 5);
  }
  for (int i = 0; i < size; ++i) other[i] -= 2 * solution[i];
  Numbers y(size), r = test::product(matrix, other);
  gmres.solve(apply, motion, r, 1e-11, y, &kept);
  EXPECT_EQ(gmres.iterations(), 1);
  EXPECT_LT(test::largest(test::difference(y, other)), 1e-11);
}

/// Directions whose images are wrong cost iterations, but the solution is right, and so is the
/// residual that is returned.
TEST_F(Equations, AreSolvedWithDirectionsOfOtherEquations)
{
  KeptDirections kept(3);
  for (int n = 0; n < 5; ++n) {
    for (int i = 0; i < size; ++i) {
      matrix[i][(i + n) % size] += 0.2;
      solution[i] += 0.1 * std::sin(i * n);
    }
    const Numbers r = test::product(matrix, solution);
    Numbers y(size), overwritten = r;
    const double residual = gmres.solve(apply, motion, overwritten, 1e-3, y, &kept);
    const Numbers left = test::difference(r, test::product(matrix, y));
    EXPECT_LE(residual, 1e-3);
    EXPECT_NEAR(residual, std::sqrt(dot(motion, left, left)), 1e-12);
  }
}

TEST_F(Equations, ForgetDirections)
{
  KeptDirections kept(1);
  Numbers y(size), r = test::product(matrix, solution), again = r;
  gmres.solve(apply, motion, r, 1e-12, y, &kept);
  const int iterations = gmres.iterations();
  kept.forget();
  y.assign(size, 0.0);
  gmres.solve(apply, motion, again, 1e-12, y, &kept);
  EXPECT_EQ(gmres.iterations(), iterations);
}

/// As many iterations as the operator has eigenvalues.
TEST(Gmres, EndsWhereTheSolutionIsExact)
{
  test::GivenMotion motion = test::linear_motion({{2, 0, 0}, {0, 2, 0}, {0, 0, 5}});
  const auto apply = [&](const Numbers &p, Numbers &v) { motion.velocity(p, 0, v); };
  Gmres gmres;
  Numbers y(3), r{1, 2, 3};
  gmres.solve(apply, motion, r, 1e-13, y);
  EXPECT_EQ(gmres.iterations(), 2);
  EXPECT_NEAR(y[0], 0.5, 1e-14);
  EXPECT_NEAR(y[1], 1.0, 1e-14);
  EXPECT_NEAR(y[2], 0.6, 1e-14);
}

}    // namespace
