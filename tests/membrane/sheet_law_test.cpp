// Sheet laws: derivatives against finite differences, tensions against closed forms and published
// values.

#include "test_support.h"

using namespace test;
using rbc::MooneyRivlin;
using rbc::NeoHookean;
using rbc::SheetEnergy;
using rbc::Skalak;

namespace {

/// Tension along the first axis per deformed length, (1/l2) dW/dl1, from the invariants i1 = l1^2 +
/// l2^2, J = l1 l2.
template <typename Law> double tension(const Law &law, double l1, double l2)
{
  const SheetEnergy W = law(l1 * l1 + l2 * l2, l1 * l2);
  return (W.by_i1 * 2 * l1 + W.by_J * l2) / l2;
}

/// The other stretch of a sheet pulled along one axis only.
template <typename Law> double free_stretch(const Law &law, double l1)
{
  double lo = 0.1, hi = 2;
  for (int n = 0; n < 100; ++n) {
    const double l2 = (lo + hi) / 2;
    (tension(law, l2, l1) > 0 ? hi : lo) = l2;
  }
  return lo;
}

template <typename Law> void expect_derivatives(const Law &law)
{
  Random random(7);
  for (int n = 0; n < 200; ++n) {
    const double l1 = random.between(0.5, 3), l2 = random.between(0.5, 3), i1 = l1 * l1 + l2 * l2,
                 J = l1 * l2;
    const auto derivative = [](const auto &f) {
      const double step = 2e-4;
      return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
    };
    const SheetEnergy W = law(i1, J);
    const double scale = std::abs(W.by_i1) + std::abs(W.by_J);
    EXPECT_NEAR(W.by_i1, derivative([&](double d) { return law(i1 + d, J).density; }),
                1e-9 * scale);
    EXPECT_NEAR(W.by_J, derivative([&](double d) { return law(i1, J + d).density; }), 1e-9 * scale);
  }
}

/// No energy and no tension at rest; small strains give shear modulus Gs and area modulus Ks.
template <typename Law> void expect_moduli(const Law &law, double Gs, double Ks)
{
  EXPECT_NEAR(law(2, 1).density, 0, 1e-15 * Gs);
  EXPECT_NEAR(tension(law, 1, 1), 0, 1e-15 * Gs);
  const double strain = 1e-4;
  const auto modulus = [&](const auto &W) { return (W(strain) + W(-strain)) / (strain * strain); };
  // W = Ks/2 (e1 + e2)^2 + Gs/2 (e1 - e2)^2 for Hencky strains
  const auto at = [&](double e1, double e2) {
    const double l1 = std::exp(e1), l2 = std::exp(e2);
    return law(l1 * l1 + l2 * l2, l1 * l2).density;
  };
  EXPECT_NEAR(modulus([&](double e) { return at(e / 2, -e / 2); }), Gs, 1e-6 * Gs);
  EXPECT_NEAR(modulus([&](double e) { return at(e / 2, e / 2); }), Ks, 1e-6 * Ks);
}

TEST(SheetLaw, DerivativesAreThoseOfTheDensity)
{
  expect_derivatives(NeoHookean(1.7));
  expect_derivatives(MooneyRivlin(0, 300, 0.01));
  expect_derivatives(MooneyRivlin(200, 30, 0.01));
  expect_derivatives(Skalak(0.6, 0));
  expect_derivatives(Skalak(0.6, 50));
}

TEST(SheetLaw, SmallStrainModuli)
{
  expect_moduli(NeoHookean(1.7), 1.7, 3 * 1.7);
  expect_moduli(MooneyRivlin(2.57e2, 2.57e1, 0.01), 2 * 2.827, 6 * 2.827);
  for (double C : {0.0, 1.0, 10.0, 100.0}) expect_moduli(Skalak(0.6, C), 0.6, (1 + 2 * C) * 0.6);
}

/// To the digits printed.
void expect_as_printed(double value, double printed)
{
  EXPECT_NEAR(value, printed, 6e-7 * std::abs(printed));
}

/// A law that is named in input scripts is made from the values given there, in their order.
TEST(SheetLaw, TableMakesTheLawOfAName)
{
  using rbc::SheetLaw;
  EXPECT_EQ(rbc::law_names<SheetLaw>(), "mooney-rivlin, neo-hookean, skalak");
  const auto expect_made = [](const std::string &word, const std::vector<double> &values,
                              const auto &law) {
    const std::size_t index = rbc::law_index<SheetLaw>(word);
    ASSERT_EQ(rbc::law_parameters<SheetLaw>(index).size(), values.size());
    const SheetLaw made = rbc::make_law<SheetLaw>(index, values);
    const auto energy = [](const auto &W) { return W(2.6, 1.2).density; };
    EXPECT_EQ(std::visit(energy, made), energy(law));
  };
  expect_made("mooney-rivlin", {200, 30, 0.01}, MooneyRivlin(200, 30, 0.01));
  expect_made("neo-hookean", {1.7}, NeoHookean(1.7));
  expect_made("skalak", {0.6, 50}, Skalak(0.6, 50));
  EXPECT_EQ(rbc::law_index<SheetLaw>("hooke"), std::variant_size_v<SheetLaw>);
}

TEST(SheetLaw, MooneyRivlinTensions)
{
  const Table table("membrane/data/08a_mooney_rivlin_membrane_closed_forms.csv");
  for (int row = 0; row < table.rows(); ++row) {
    const double psi = table.number(row, "psi"), l = table.number(row, "lambda");
    SCOPED_TRACE("psi " + std::to_string(psi) + ", lambda " + std::to_string(l));
    const double h = 0.02;
    const MooneyRivlin law(psi / (2 * h), (1 - psi) / (2 * h), h);    // Gs = 1
    const auto expect = [&](double value, const char *column) {
      expect_as_printed(value, table.number(row, column));
    };
    expect(tension(law, l, 1 / std::sqrt(l)), "T_uniaxial");
    EXPECT_NEAR(tension(law, 1 / std::sqrt(l), l), 0, 1e-13 * l * l);
    expect(tension(law, l, 1), "T1_planar");
    expect(tension(law, l, l), "T_equibiaxial");
    expect(2 * tension(law, l, l) / l, "pR0_balloon");
    expect(tension(law, l, 1 / l), "T1_pureshear");
    expect(tension(law, 1 / l, l), "T2_pureshear");
  }
}

TEST(SheetLaw, NeoHookeanBalloonIsWeakestBeyondItsLimitPoint)
{
  const NeoHookean law(1);
  const auto pressure = [&](double l) { return 2 * tension(law, l, l) / l; };
  const double limit = std::pow(7, 1.0 / 6);
  EXPECT_NEAR(pressure(limit), 2 * (1 / limit - 1 / (7 * limit)), 1e-14);
  EXPECT_LT(pressure(limit * 0.99), pressure(limit));
  EXPECT_LT(pressure(limit * 1.01), pressure(limit));
}

TEST(SheetLaw, SkalakTensions)
{
  const Table table("membrane/data/08b_skalak_closed_forms.csv");
  for (int row = 0; row < table.rows(); ++row) {
    const double l = table.number(row, "lambda");
    const Skalak law(1, table.number(row, "C"));
    expect_as_printed(tension(law, l, l), table.number(row, "T_equibiaxial"));
    expect_as_printed(2 * tension(law, l, l) / l, table.number(row, "pR0_balloon"));
    expect_as_printed(tension(law, l, 1 / l), table.number(row, "T1_pureshear"));
  }
}

TEST(SheetLaw, UniaxialTensionsOfBarthesBieselDiazAndDhenin)
{
  // Points read off a figure: within 3 % of the range of the curve.
  const Table table("membrane/data/08d_uniaxial_membrane_BB2002.csv");
  for (int row = 0; row < table.rows(); ++row) {
    const double l = std::sqrt(1 + 2 * table.number(row, "green_strain"));
    const double expected = table.number(row, "T1_over_modulus");
    if (table.text(row, "law") == "neo-Hookean") {
      const NeoHookean law(1);
      EXPECT_NEAR(free_stretch(law, l), 1 / std::sqrt(l), 1e-14);
      EXPECT_NEAR(tension(law, l, free_stretch(law, l)), expected, 0.03 * 1.9);
    } else {
      const Skalak law(1, 1);
      EXPECT_NEAR(tension(law, l, free_stretch(law, l)), expected, 0.03 * 5.6);
    }
  }
}

}    // namespace
