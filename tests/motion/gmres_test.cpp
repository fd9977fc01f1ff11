#include "motion/gmres.h"

#include "test_motion.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using rbc::Gmres;
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
  Numbers y(size, 1.0);
  EXPECT_LE(gmres.solve(apply, motion, test::product(matrix, solution), 1e-12, y), 1e-12);
  for (double &value : y) value -= 1;
  EXPECT_LT(test::largest(test::difference(y, solution)), 1e-12);
  EXPECT_LE(gmres.iterations(), size);
  EXPECT_EQ(motion.evaluations, gmres.iterations());
}

TEST_F(Equations, EndAtTheLargestNumberOfIterationsWithTheResidualThere)
{
  const Numbers r = test::product(matrix, solution);
  Numbers y(size);
  gmres.max_iterations = 4;
  const double residual = gmres.solve(apply, motion, r, 1e-12, y);
  EXPECT_EQ(gmres.iterations(), 4);
  const Numbers left = test::difference(r, test::product(matrix, y));
  EXPECT_NEAR(residual, std::sqrt(dot(motion, left, left)), 1e-12);
}

TEST_F(Equations, WithNothingToDoCostNothing)
{
  Numbers y = solution;
  EXPECT_EQ(gmres.solve(apply, motion, Numbers(size), 0.0, y), 0);
  EXPECT_EQ(y, solution);
  EXPECT_EQ(motion.evaluations, 0);
}

/// A bound that no one reaches must cost nothing.
TEST_F(Equations, TakeTheMemoryOfTheIterationsMade)
{
  gmres.max_iterations = std::numeric_limits<int>::max();
  Numbers y(size);
  EXPECT_LE(gmres.solve(apply, motion, test::product(matrix, solution), 1e-12, y), 1e-12);
  EXPECT_LT(test::largest(test::difference(y, solution)), 1e-12);
  const std::size_t vectors = gmres.iterations() + 1;
  EXPECT_LE(gmres.bytes(), 2 * vectors * (size + vectors) * sizeof(double));

  const std::size_t before = gmres.bytes();
  y.assign(size, 0.0);
  gmres.solve(apply, motion, test::product(matrix, solution), 1e-12, y);
  EXPECT_EQ(gmres.bytes(), before);
}

/// As many iterations as the operator has eigenvalues.
TEST(Gmres, EndsWhereTheSolutionIsExact)
{
  test::GivenMotion motion = test::linear_motion({{2, 0, 0}, {0, 2, 0}, {0, 0, 5}});
  const auto apply = [&](const Numbers &p, Numbers &v) { motion.velocity(p, 0, v); };
  Gmres gmres;
  Numbers y(3);
  gmres.solve(apply, motion, {1, 2, 3}, 1e-13, y);
  EXPECT_EQ(gmres.iterations(), 2);
  EXPECT_NEAR(y[0], 0.5, 1e-14);
  EXPECT_NEAR(y[1], 1.0, 1e-14);
  EXPECT_NEAR(y[2], 0.6, 1e-14);
}

}    // namespace
