// A whole cell stretched uniformly: energies, virial and pressure in closed form.

#include "test_support.h"

using namespace test;

namespace {

using Density = double (*)(double i1, double J);

struct LawInClosedForm {
  rbc::SheetLaw law;
  Density density;
};

const LawInClosedForm laws[] = {
    {rbc::NeoHookean(2), [](double i1, double J) { return i1 + 1 / (J * J) - 3; }},
    {rbc::MooneyRivlin(30, 70, 0.01),
     [](double i1, double J) {
       return 0.3 * (i1 + 1 / (J * J) - 3) + 0.7 * (J * J + i1 / (J * J) - 3);
     }},
    {rbc::Skalak(4, 3), [](double i1, double J) {
       return std::pow(i1 - 2, 2) + 2 * (i1 - 2) - 2 * (J * J - 1) + 3 * std::pow(J * J - 1, 2);
     }}};

TEST(SheetStretch, EnergyOfACuboidUnderAnyLinearMap)
{
  const Vec3 size(1.3, 0.7, 2.1);
  const rbc::SurfaceTemplate shape = cuboid(size, 3).surface();
  Random random(3);
  for (const auto &[law, density] : laws) {
    rbc::MembraneParameters parameters;
    parameters.law = law;
    rbc::MembraneModel model(shape, parameters);
    for (int n = 0; n < 20; ++n) {
      Matrix3 map = Matrix3::Identity();
      for (int c = 0; c < 3; ++c) map.col(c) += random.vector(-0.4, 0.4);
      const Matrix3 metric = map.transpose() * map;
      double expected = 0;
      for (int d = 0; d < 3; ++d) {
        const int a = (d + 1) % 3, b = (d + 2) % 3;
        const double J = std::sqrt(metric(a, a) * metric(b, b) - metric(a, b) * metric(b, a));
        expected += 2 * size[a] * size[b] * density(metric(a, a) + metric(b, b), J);
      }
      const Result result = evaluate(
          model, shape, transformed(shape.vertices, [&](const Vec3 &x) { return Vec3(map * x); }));
      EXPECT_NEAR(result.energy.sheet, expected, 1e-13 * expected);
      EXPECT_EQ(result.energy.total(), result.energy.sheet);
    }
  }
}

double virial(const Vertices &x, const Vertices &force)
{
  double sum = 0;
  for (std::size_t v = 0; v < x.size(); ++v) sum += x[v].dot(force[v]);
  return sum;
}

Vertices inflated(const rbc::SurfaceTemplate &shape, double stretch)
{
  return transformed(shape.vertices, [&](const Vec3 &x) { return Vec3(stretch * x); });
}

TEST(SheetStretch, VirialOfABalloonIsTensionTimesArea)
{
  const rbc::SurfaceTemplate shape = icosphere(5).surface();
  for (double psi : {1.0, 0.9, 0.5, 0.0})
    for (double l : {1.001, 1.1, 1.5, 3.0, 5.0}) {
      rbc::MembraneParameters parameters;
      parameters.law = rbc::MooneyRivlin(psi / 2, (1 - psi) / 2, 1);
      const Vertices x = inflated(shape, l);
      const Result result = evaluate(shape, parameters, x);
      const double tension = (1 - std::pow(l, -6)) * (psi + (1 - psi) * l * l);
      EXPECT_NEAR(-virial(x, result.force), 2 * tension * l * l * shape.area,
                  1e-13 * total_norm(x));
    }
}

TEST(SheetStretch, PressureInABalloonIsOfSecondOrder)
{
  const Table table("08a_mooney_rivlin_membrane_closed_forms.csv");
  for (int row = 0; row < table.rows(); row += 5) {
    const double psi = table.number(row, "psi"), l = table.number(row, "lambda");
    rbc::MembraneParameters parameters;
    parameters.law = rbc::MooneyRivlin(psi / 2, (1 - psi) / 2, 1);
    double last = 0;
    for (int frequency : {4, 8, 16}) {
      const rbc::SurfaceTemplate shape = icosphere(frequency).surface();
      const Vertices x = inflated(shape, l);
      const Result result = evaluate(shape, parameters, x);
      // The pressure that balances the forces of the membrane under a uniform growth.
      const double pressure = -virial(x, result.force) / (3 * result.size.volume);
      const double error = pressure / table.number(row, "pR0_balloon") - 1;
      if (frequency > 4) {
        EXPECT_NEAR(order(last, error), 2, 0.1);
      }
      last = error;
    }
    EXPECT_LT(std::abs(last), 4e-3);
  }
}

TEST(SheetStretch, PenaltiesOfAnInflatedCell)
{
  const rbc::SurfaceTemplate shape = disc(4).surface();
  rbc::MembraneParameters parameters;
  parameters.law = rbc::Skalak(0, 0);
  parameters.local_area = 3;
  for (double l : {0.8, 1.1, 2.0}) {
    const Vertices x = inflated(shape, l);
    const double area_strain = l * l - 1, volume_strain = l * l * l - 1;
    parameters.global_area = 0;
    parameters.volume = 0;
    const rbc::MembraneEnergy local = evaluate(shape, parameters, x).energy;
    EXPECT_NEAR(local.area, 1.5 * area_strain * area_strain * shape.area, 1e-12 * shape.area);
    EXPECT_EQ(local.volume, 0);
    parameters.global_area = 5;
    parameters.volume = 7;
    const rbc::MembraneEnergy all = evaluate(shape, parameters, x).energy;
    EXPECT_NEAR(all.area, 4 * area_strain * area_strain * shape.area, 1e-12 * shape.area);
    EXPECT_NEAR(all.volume, 3.5 * volume_strain * volume_strain * shape.volume,
                1e-11 * shape.volume);
    EXPECT_EQ(all.sheet, 0);
    EXPECT_EQ(all.bending, 0);
  }
}

}    // namespace
