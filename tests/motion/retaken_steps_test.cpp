#include "motion/runge_kutta_chebyshev.h"
#include "test_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using rbc::Numbers;
using rbc::RungeKuttaChebyshev;

namespace {

/// Vectors of a few points on one rank.
class Store : public rbc::PointStore {
 public:
  explicit Store(std::size_t numbers) : vectors_(4, Numbers(numbers)) {}
  void load(int vector, Numbers &values) const override { values = vectors_[vector]; }
  void store(int vector, const Numbers &values) override { vectors_[vector] = values; }
  int known_steps(std::size_t) const override { return known_; }
  void set_known_steps(int steps) override { known_ = steps; }

 private:
  std::vector<Numbers> vectors_;
  int known_ = 0;
};

/// x' = -rate_i x, where the rate of the last number is one that can be changed at any time.
class Relaxing : public rbc::Motion {
 public:
  double last_rate = 0.1;
  double drift = 0;    // of the first number, which does not relax with it
  std::vector<int> divided;
  double furthest_fraction = 0;

  void velocity(const Numbers &x, double fraction, Numbers &v) override
  {
    v.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      v[i] = -(i + 1 == x.size() ? last_rate : 0.1 * static_cast<double>(i + 1)) * x[i];
    if (drift > 0) v[0] = drift;
    furthest_fraction = std::max(furthest_fraction, fraction);
  }
  void sum(double *, int) const override {}
  void divide_step(int parts) override { divided.push_back(parts); }
};

class RetakenStep : public testing::Test {
 protected:
  static constexpr double dt = 10;
  Relaxing motion;
  Numbers x = {1, 1, 1, 1, 1, 1e-3}, v, end;
  Store store{6};
  RungeKuttaChebyshev method{0, 2};
  std::int64_t number = 0;

  RetakenStep() { method.start_run(1.0, false, false); }

  void take()
  {
    motion.velocity(x, 0, v);
    method.step(motion, store, {x, v, dt, dt, number}, end);
  }
  void accept()
  {
    method.accept(store, {x, v, dt, dt, number}, end);
    x = end;
    ++number;
  }
  bool refuse()
  {
    method.reject(motion, store, {x, v, dt, dt, number}, end);
    return method.retake();
  }
};

/// A mode becomes fast between two estimates. The step would multiply it by thousands; taken again
/// it falls, and the slow numbers are where they would be anyhow.
TEST_F(RetakenStep, IsStableForAModeThatWasMissed)
{
  for (int n = 0; n < 3; ++n) {
    take();
    EXPECT_FALSE(method.has_grown());
    accept();
  }
  const int stages = method.stages();
  motion.last_rate = 100;
  const double before = std::abs(x[5]);
  take();
  ASSERT_GT(std::abs(end[5]), 1e3 * before);
  EXPECT_TRUE(method.has_grown());
  ASSERT_TRUE(refuse());
  take();
  EXPECT_FALSE(method.has_grown());
  EXPECT_LT(std::abs(end[5]), before);
  EXPECT_GT(method.stages(), 5 * stages);
  EXPECT_NEAR(end[0], x[0] * std::exp(-0.1 * dt), 0.06 * x[0]);
  for (int i = 1; i < 5; ++i) EXPECT_LT(std::abs(end[i]), std::abs(x[i]));
}

/// All points together are hardly driven back where one of them drifts: what has grown is found
/// while it is small.
TEST_F(RetakenStep, IsStableForAModeThatADriftHides)
{
  motion.drift = 10;
  x = {0, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3};
  take();
  accept();
  motion.last_rate = 1.2;
  int grown = 0;
  double furthest = 0;
  for (int n = 0; n < 30; ++n) {
    take();
    if (method.has_grown()) {
      ++grown;
      ASSERT_TRUE(refuse());
      take();
      EXPECT_FALSE(method.has_grown());
    }
    accept();
    furthest = std::max(furthest, std::abs(x[5]));
  }
  EXPECT_EQ(grown, 1);
  EXPECT_LT(furthest, 0.4);    // of the length that the method was given
  EXPECT_LT(std::abs(x[5]), 0.01);
  EXPECT_NEAR(x[0], 31 * dt * motion.drift, 1e-6);
}

/// More stages even where the estimate is what it was; then in parts; then no more.
TEST_F(RetakenStep, IsTakenWithMoreStagesThenInPartsAndNotWithoutEnd)
{
  take();
  accept();
  take();
  const int stages = method.stages();
  std::vector<int> parts;
  int retakes = 0;
  while (refuse()) {
    motion.divided.clear();
    take();
    if (++retakes == 1) {
      EXPECT_GT(method.stages(), stages);
    }
    parts.push_back(motion.divided.empty() ? 1 : motion.divided.front());
    if (parts.back() > 1) {
      EXPECT_EQ(motion.divided.back(), 1);
    }
  }
  EXPECT_EQ(parts, (std::vector<int>{1, 2, 4, 8, 16, 32}));

  // the last is the most accurate: of second order in the parts
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(end[i] / x[i], std::exp(-0.1 * (i + 1) * dt), 1e-3);
  EXPECT_LE(motion.furthest_fraction, 1);

  // the next step begins anew
  accept();
  motion.divided.clear();
  take();
  EXPECT_TRUE(motion.divided.empty());
  EXPECT_TRUE(refuse());
}

/// Stages rise at once and fall slowly.
TEST_F(RetakenStep, LeavesMoreStagesForAWhile)
{
  take();
  accept();
  take();
  const double radius = method.spectral_radius();
  ASSERT_TRUE(refuse());
  take();
  double last = method.spectral_radius();
  EXPECT_NEAR(last, 2.25 * radius, 0.05 * radius);
  int falling = 0;
  for (accept(); method.spectral_radius() > 1.1 * radius; ++falling) {
    EXPECT_GE(method.spectral_radius(), 0.97 * last);
    last = method.spectral_radius();
    take();
    accept();
    ASSERT_LT(falling, 100);
  }
  EXPECT_GT(falling, 20);
}

TEST(FixedStages, AreNotTakenAgain)
{
  RungeKuttaChebyshev method(5, 2);
  EXPECT_FALSE(method.can_retake());
  EXPECT_FALSE(method.retake());
}

}    // namespace
