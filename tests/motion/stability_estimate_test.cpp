#include "motion/stability_estimate.h"
#include "test_motion.h"

#include <gtest/gtest.h>

namespace {

using rbc::Numbers;
using rbc::StabilityEstimate;

/// One vector of the points.
struct Store : rbc::PointStore {
  Numbers mode;

  explicit Store(std::size_t numbers) : mode(numbers) {}
  void load(int, Numbers &values) const override { values = mode; }
  void store(int, const Numbers &values) override { mode = values; }
  int known_steps(std::size_t) const override { return 0; }
  void set_known_steps(int) override {}
};

/// Points that relax with rates from 0 to the stiffness.
struct Relaxation {
  double stiffness = 3;
  double bearable = 4;
  Numbers x = Numbers(30, 1.0), v = Numbers(30);
  test::GivenMotion motion{[this](const Numbers &at, double, Numbers &rate) {
    for (std::size_t i = 0; i < at.size(); ++i)
      rate[i] = -stiffness * double(i) / double(at.size() - 1) * at[i];
  }};

  double radius(StabilityEstimate &estimate, Store &store, int step)
  {
    motion.velocity(x, 0, v);
    return estimate.radius(motion, store, 0, {x, v, 0.1, 0.1, step}, bearable);
  }
};

/// Runs that continue each other, by memory or by a restart file, are one run: radii are the same,
/// bit for bit.
TEST(StabilityEstimate, GoesOnFromRunToRun)
{
  Relaxation relaxation;
  Store store(30), pieces(30);
  StabilityEstimate whole, part;
  whole.start_run(1, false, false);
  part.start_run(1, false, false);
  for (int step = 1; step < 40; ++step) {
    relaxation.stiffness = 3 + 0.01 * step;
    const double expected = relaxation.radius(whole, store, step);
    EXPECT_EQ(relaxation.radius(part, pieces, step), expected);
    EXPECT_GT(expected, relaxation.stiffness);
    if (step % 3 == 0) {
      StabilityEstimate read;
      read.restore(part.state());
      part = read;
    }
    part.start_run(1, true, false);
  }
  EXPECT_EQ(pieces.mode, store.mode);
}

/// What has become stiffer between runs than steps can bear is found at their start, though no
/// estimate is due, and with it one that was made without a past.
TEST(StabilityEstimate, IsMadeAnewWhereItNoLongerHolds)
{
  for (double factor : {1.0, 1.1, 2.0, 100.0}) {
    Relaxation relaxation;
    Store store(30);
    StabilityEstimate estimate;
    estimate.start_run(1, false, false);
    const double before = relaxation.radius(estimate, store, 1);
    relaxation.stiffness *= factor;
    estimate.start_run(1, true, true);
    const double after = relaxation.radius(estimate, store, 2);
    if (factor * 3 < relaxation.bearable)
      EXPECT_EQ(after, before);
    else
      EXPECT_GT(after, relaxation.stiffness);
  }
}

TEST(StabilityEstimate, IsMadeAtTheStartOfAnotherRun)
{
  Relaxation relaxation;
  Store store(30);
  StabilityEstimate estimate;
  estimate.start_run(1, false, false);
  relaxation.radius(estimate, store, 1);
  relaxation.stiffness /= 10;
  estimate.start_run(1, false, false);
  EXPECT_LT(relaxation.radius(estimate, store, 2), 3);
}

}    // namespace
