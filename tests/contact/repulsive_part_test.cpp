#include "contact/repulsive_part.h"

#include "../geometry/test_support.h"

using rbc::ContactLaw;
using rbc::HertzContact;
using rbc::JkrContact;
using rbc::RepulsivePart;

namespace {

const ContactLaw laws[] = {JkrContact(0.0628, 1e-3, 0.3), HertzContact(0.1, 0.3)};

TEST(RepulsivePart, BeginsWithoutForceAndEnergy)
{
  for (const ContactLaw &law : laws) {
    const RepulsivePart part(law);
    const auto [traction, energy] = part.at(part.range());
    EXPECT_NEAR(traction, 0, 1e-14);
    EXPECT_NEAR(energy, 0, 1e-14);
  }
}

TEST(RepulsivePart, TractionIsMinusTheDerivativeOfTheEnergy)
{
  constexpr double step = 1e-5;
  for (const ContactLaw &law : laws) {
    const RepulsivePart part(law);
    for (double gap = -0.1; gap < part.range() - step; gap += 0.01) {
      const double slope = (part.at(gap + step).energy - part.at(gap - step).energy) / (2 * step);
      EXPECT_NEAR(part.at(gap).traction, -slope, 1e-8 * part.at(0).traction) << "gap " << gap;
      EXPECT_GT(part.at(gap).traction, 0);
      EXPECT_GT(part.at(gap).energy, 0);
    }
  }
}

// Hertz: F = K a^3 / R on each area pi R^2, a^2 = R h, from a gap of R on.
TEST(RepulsivePart, OfHertzIsAllOfIt)
{
  const RepulsivePart part(HertzContact(0.1, 0.3));
  EXPECT_DOUBLE_EQ(part.range(), 0.3);
  const double h = 0.3 - 0.12;
  EXPECT_NEAR(part.at(0.12).traction, 0.1 * std::pow(h / 0.3, 1.5) / test::pi, 1e-15);
}

// In equation 7 the force is zero at h = delta0 / 3, delta0 = (6 pi sigma R^2 / K)^(2/3) / R.
TEST(RepulsivePart, OfAdhesionBeginsWhereItRests)
{
  const RepulsivePart part(JkrContact(0.0628, 1e-3, 0.3));
  const double a0 = std::cbrt(6 * test::pi * 1e-3 * 0.09 / 0.0628);
  EXPECT_NEAR(part.range(), 0.3 - a0 * a0 / 0.3 / 3, 1e-14);
}

}    // namespace
