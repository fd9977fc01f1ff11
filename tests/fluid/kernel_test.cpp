// Regularised delta functions: their published formulas and moments.

#include "fluid/kernel.h"
#include "test_support.h"

using namespace test;

namespace {

/// Visits positions s, half and whole ones included: check(s, weights, first).
template <typename Kernel, typename Check> void for_each_position(Check check)
{
  for (int n = -400; n <= 400; ++n) {
    const double s = n / 64.0;
    std::array<double, 4> w;
    const int first = Kernel::weights(s, w.data());
    SCOPED_TRACE(s);
    check(s, w, first);
  }
}

template <typename Kernel> class KernelTest : public testing::Test {
};
using Kernels = testing::Types<Peskin4, Roma3>;
TYPED_TEST_SUITE(KernelTest, Kernels);

TYPED_TEST(KernelTest, SumIsOneAndFirstMomentZero)
{
  for_each_position<TypeParam>([](double s, const std::array<double, 4> &w, int first) {
    double sum = 0, moment = 0;
    for (int i = 0; i < 4; ++i) {
      sum += w[i];
      moment += w[i] * (first + i - s);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_NEAR(moment, 0, 1e-15);
  });
}

double peskin4(double r)
{
  r = std::abs(r);
  if (r <= 1) return (3 - 2 * r + std::sqrt(1 + 4 * r - 4 * r * r)) / 8;
  if (r <= 2) return (5 - 2 * r - std::sqrt(-7 + 12 * r - 4 * r * r)) / 8;
  return 0;
}

double roma3(double r)
{
  r = std::abs(r);
  if (r <= 0.5) return (1 + std::sqrt(1 - 3 * r * r)) / 3;
  if (r <= 1.5) return (5 - 3 * r - std::sqrt(1 - 3 * (1 - r) * (1 - r))) / 6;
  return 0;
}

template <typename Kernel> void expect_formula(double (*formula)(double))
{
  for_each_position<Kernel>([&](double s, const std::array<double, 4> &w, int first) {
    for (int i = first - 4; i < first + 8; ++i) {
      const double weight = i >= first && i < first + 4 ? w[i - first] : 0;
      EXPECT_NEAR(weight, formula(i - s), 1e-15);
    }
  });
}

TEST(Kernel, Peskin4IsAsPublished)
{
  expect_formula<Peskin4>(peskin4);
}
TEST(Kernel, Roma3IsAsPublished)
{
  expect_formula<Roma3>(roma3);
}

TEST(Kernel, Peskin4WeighsEvenAndOddPointsAlike)
{
  for_each_position<Peskin4>([](double, const std::array<double, 4> &w, int) {
    EXPECT_NEAR(w[0] + w[2], 0.5, 1e-15);
    EXPECT_NEAR(w[1] + w[3], 0.5, 1e-15);
  });
}

/// 3/8 and 1/2 wherever the marker is.
template <typename Kernel> void expect_sum_of_squares(double expected)
{
  for_each_position<Kernel>([&](double, const std::array<double, 4> &w, int) {
    EXPECT_NEAR(w[0] * w[0] + w[1] * w[1] + w[2] * w[2] + w[3] * w[3], expected, 1e-15);
  });
}

TEST(Kernel, Peskin4HasAConstantSumOfSquares)
{
  expect_sum_of_squares<Peskin4>(0.375);
}
TEST(Kernel, Roma3HasAConstantSumOfSquares)
{
  expect_sum_of_squares<Roma3>(0.5);
}

}    // namespace
