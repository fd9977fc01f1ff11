#include "contact/contact_laws.h"

#include "../geometry/test_support.h"

using rbc::HertzContact;
using rbc::JkrContact;
using test::pi;

namespace {

test::Table reference(const std::string &name)
{
  return test::Table("contact/data/" + name);
}

/// Half of the last of the eight digits that the tables have.
double rounding(double number)
{
  return number == 0 ? 0 : 0.5 * std::pow(10, std::floor(std::log10(std::abs(number))) - 7);
}

/// A tip and the scales of the dimensionless curve.
struct Scaled {
  explicit Scaled(double K = 0.07, double sigma = 0.0013, double R = 0.31) :
      K(K), sigma(sigma), R(R), a0(std::cbrt(6 * pi * sigma * R * R / K)), delta0(a0 * a0 / R),
      F0(pi * sigma * R), tip(K, sigma, R)
  {
  }

  double K, sigma, R, a0, delta0, F0;
  JkrContact tip;

  double force(double h) const { return tip.force(h * delta0) / F0; }
  /// Slope of the force by the overlap, from the derivatives of both by the radius of the contact.
  double stiffness(double h) const
  {
    const double x = contact_radius(h), x32 = x * std::sqrt(x);
    return x * (3 * x32 - 1.5) / (2 * x32 - 1.0 / 3);
  }
  double contact_radius(double h) const { return tip.contact_radius(h * delta0) / a0; }

  /// Equation 7 as printed.
  double printed_force(double a) const
  {
    return K * a * a * a / R - std::sqrt(6 * pi * sigma * K * a * a * a);
  }
  double printed_overlap(double a) const
  {
    return a * a / R - 2.0 / 3 * std::sqrt(6 * pi * sigma * a / K);
  }
};

// Allowed is the rounding of what is looked up and of what is found.
TEST(Adhesive, ReferenceCurve)
{
  const Scaled scaled;
  const test::Table table = reference("06b_jkr_curve.csv");
  const auto half = [&](int row, const char *column) {
    return rounding(table.number(row, column));
  };
  double worst = 0;
  for (int row = 1; row < table.rows();
       ++row) {    // the first is separation, where the stiffness has no limit
    const double x = table.number(row, "a_over_a0"), h = table.number(row, "h_over_delta0");
    const double slope = 2 * x - 1 / (3 * std::sqrt(x)), stiffness = scaled.stiffness(h);
    const double half_h = half(row, "h_over_delta0");
    EXPECT_NEAR(scaled.contact_radius(h), x, half(row, "a_over_a0") + half_h / slope);
    const double off = std::abs(scaled.force(h) - table.number(row, "F_over_pi_sigma_R"));
    EXPECT_LE(off, half(row, "F_over_pi_sigma_R") + 6 * std::abs(stiffness) * half_h) << x;
    EXPECT_NEAR(stiffness, table.number(row, "dFdh_over_K_a0"), 1e-6) << x;
    worst = std::max(worst, off / std::max(1.0, scaled.force(h)));
  }
  std::cout << "force off the table by at most " << worst << " pi sigma R, or of itself\n";
}

TEST(Adhesive, CharacteristicPoints)
{
  const Scaled scaled;
  const JkrContact &tip = scaled.tip;
  const test::Table table = reference("06a_jkr_characteristic_points.csv");
  ASSERT_EQ(table.rows(), 4);
  const auto agree = [&](double found, int row, const char *column) {
    EXPECT_NEAR(found, table.number(row, column), rounding(table.number(row, column)) + 1e-12)
        << table.text(row, "point");
  };
  const double overlap[] = {tip.equilibrium_overlap(), 0, -std::cbrt(0.5) / 6 * scaled.delta0,
                            tip.detachment_overlap()};
  for (int row = 0; row < 4; ++row) {
    agree(overlap[row] / scaled.delta0, row, "h_over_delta0");
    agree(tip.contact_radius(overlap[row]) / scaled.a0, row, "a_over_a0");
    agree(tip.force(overlap[row]) / scaled.F0, row, "F_over_pi_sigma_R");
  }
  EXPECT_NEAR(tip.pull_off() / scaled.F0, 1.5, 1e-12);
  EXPECT_NEAR(tip.energy(tip.detachment_overlap()) / (scaled.F0 * scaled.delta0), 0, 1e-15);
}

TEST(Adhesive, SolvesEquation7)
{
  double worst = 0;
  for (double sigma : {1e-6, 1e-3, 2.0})
    for (double K : {0.05, 3.0}) {
      const Scaled scaled(K, sigma, 0.4);
      const double separation = 0.30285343213868998 * scaled.a0;
      for (double factor = 1 + 1e-5; factor < 1e4; factor = 1 + (factor - 1) * 1.1) {
        const double a = factor * separation;
        const double h = scaled.printed_overlap(a);
        // ten roundings in h, which near separation depends little on a
        const double conditioning = 10 * 2.2e-16 / (1 - std::pow(factor, -1.5));
        const double off = std::abs(scaled.tip.contact_radius(h) / a - 1);
        EXPECT_LT(off, conditioning) << factor;
        worst = std::max(worst, off);
        EXPECT_NEAR(scaled.tip.force(h), scaled.printed_force(a),
                    4 * conditioning * (std::abs(scaled.printed_force(a)) + scaled.F0));
      }
    }
  std::cout << "radius of contact off by at most " << worst << "\n";
}

/// Integral by Simpson's rule in t of s = lo + t^2, which makes the square root at separation
/// smooth.
template <typename Function> double integral(const Function &f, double lo, double hi)
{
  constexpr int n = 4000;
  const double step = std::sqrt(hi - lo) / n;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double t = k * step;
    sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * f(lo + t * t) * 2 * t;
  }
  return sum * step / 3;
}

TEST(Adhesive, EnergyIsTheIntegralOfTheForce)
{
  const Scaled scaled;
  const JkrContact &tip = scaled.tip;
  for (double h : {-0.27, -0.1, 0.0, 1.0 / 3, 1.0, 5.0}) {
    const double expected = integral([&](double s) { return tip.force(s); },
                                     tip.detachment_overlap(), h * scaled.delta0);
    EXPECT_NEAR(tip.energy(h * scaled.delta0) / (scaled.F0 * scaled.delta0),
                expected / (scaled.F0 * scaled.delta0), 1e-9)
        << h;
  }
}

TEST(Adhesive, StiffnessIsTheSlopeOfTheForce)
{
  const Scaled scaled;
  const double step = 1e-6 * scaled.delta0;
  for (double h : {-0.2, -0.1, 0.0, 1.0 / 3, 1.0, 5.0}) {
    const double at = h * scaled.delta0;
    const double slope = (scaled.tip.force(at + step) - scaled.tip.force(at - step)) / (2 * step);
    EXPECT_NEAR(scaled.stiffness(h) * scaled.K * scaled.a0 / slope, 1, 1e-8) << h;
  }
}

TEST(Adhesive, WorkPerAreaIsThatAskedFor)
{
  for (double sigma : {1e-6, 1e-3, 2.0})
    for (double K : {0.05, 3.0})
      for (double R : {0.05, 0.4}) {
        const JkrContact tip(K, sigma, R);
        const double work = integral([&](double h) { return -tip.per_area(h).traction; },
                                     tip.detachment_overlap(), tip.equilibrium_overlap());
        EXPECT_NEAR(work / sigma, 1, 1e-9);
        EXPECT_NEAR(-tip.per_area(tip.equilibrium_overlap()).energy / sigma, 1, 1e-14);
      }
}

TEST(Repulsive, Hertz)
{
  const double K = 0.07, R = 0.31;
  const HertzContact tip(K, R);
  for (double h : {0.01, 0.1, 0.3}) {
    const double a = std::sqrt(R * h);
    EXPECT_NEAR(tip.contact_radius(h), a, 1e-15);
    EXPECT_NEAR(tip.force(h) / (K * a * a * a / R), 1, 1e-14);
    EXPECT_NEAR(tip.energy(h) / integral([&](double s) { return tip.force(s); }, 0, h), 1, 1e-9);
    const double step = 1e-5 * h, slope = (tip.force(h + step) - tip.force(h - step)) / (2 * step);
    EXPECT_NEAR(slope / (1.5 * K * a), 1, 1e-8);
    EXPECT_NEAR(tip.per_area(h).traction * pi * R * R / tip.force(h), 1, 1e-14);
    EXPECT_NEAR(tip.per_area(h).energy * pi * R * R / tip.energy(h), 1, 1e-14);
    EXPECT_NEAR(tip.force(h) / JkrContact(K, 1e-14, R).force(h), 1, 1e-5);
  }
  EXPECT_EQ(tip.force(-0.01), 0);
  EXPECT_EQ(tip.energy(-0.01), 0);
  EXPECT_EQ(tip.detachment_overlap(), 0);
}

/// A law that is named in input scripts is made from the values given there, in their order.
TEST(ContactLaws, TableMakesTheLawOfAName)
{
  using rbc::ContactLaw;
  EXPECT_EQ(rbc::law_names<ContactLaw>(), "adhesive, repulsive");
  EXPECT_EQ(rbc::parameter_names<ContactLaw>(), (std::vector<std::string>{"K", "sigma", "R"}));
  const auto force = [](const ContactLaw &made) {
    return std::visit([](const auto &law) { return law.force(0.1); }, made);
  };
  EXPECT_EQ(force(rbc::make_law<ContactLaw>(0, {0.07, 0.0013, 0.31})),
            JkrContact(0.07, 0.0013, 0.31).force(0.1));
  EXPECT_EQ(force(rbc::make_law<ContactLaw>(1, {0.07, 0.31})), HertzContact(0.07, 0.31).force(0.1));
  EXPECT_THROW(rbc::make_law<ContactLaw>(std::variant_size_v<ContactLaw>, {}),
               std::bad_variant_access);
}

}    // namespace
