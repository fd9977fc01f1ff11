// Helfrich bending: energies of spheres and the biconcave disc, normal forces on the disc.

#include "test_support.h"

#include <iostream>

using namespace test;

namespace {

rbc::MembraneParameters bending(double kappa, double c0)
{
  rbc::MembraneParameters parameters;
  parameters.law = rbc::Skalak(0, 0);
  parameters.bending = kappa;
  parameters.reference_curvature = false;
  parameters.spontaneous_curvature = c0;
  return parameters;
}

double sphere_energy(int frequency, double radius, double kappa, double c0)
{
  Mesh mesh = icosphere(frequency);
  for (Vec3 &x : mesh.vertices) x *= radius;
  return evaluate(mesh.surface(), bending(kappa, c0), mesh.vertices).energy.bending;
}

TEST(Bending, EnergyOfASphereIsOfSecondOrder)
{
  const double kappa = 0.2;
  struct {
    double radius, c0;
  } const cases[] = {{1, 0}, {3.3, 0}, {1, -2}, {2, 3}, {0.5, 1}};
  for (const auto &[radius, c0] : cases) {
    SCOPED_TRACE("R " + std::to_string(radius) + ", c0 " + std::to_string(c0));
    const double exact = kappa / 2 * std::pow(2 / radius - c0, 2) * 4 * pi * radius * radius;
    double last = 0;
    for (int frequency : {4, 8, 16, 32}) {
      const double error = sphere_energy(frequency, radius, kappa, c0) / exact - 1;
      if (frequency > 4) {
        EXPECT_NEAR(order(last, error), 2, 0.05);
      }
      last = error;
    }
    EXPECT_LT(std::abs(last), 2e-3);
  }
}

TEST(Bending, EnergyDoesNotDependOnSize)
{
  EXPECT_NEAR(sphere_energy(5, 1e-3, 1, 0), sphere_energy(5, 40, 1, 0), 1e-11);
}

TEST(Bending, EnergyOfTheDiscIsOfSecondOrder)
{
  const double exact = 48.47909;    // by quadrature
  double last = 0;
  for (int frequency : {8, 16, 32}) {
    const Mesh mesh = disc(frequency);
    const double error =
        evaluate(mesh.surface(), bending(1, 0), mesh.vertices).energy.bending / exact - 1;
    std::cout << "relative error of the energy, frequency " << frequency << ": " << error << '\n';
    if (frequency > 8) {
      EXPECT_NEAR(order(last, error), 2, 0.1);
    }
    last = error;
  }
  EXPECT_LT(std::abs(last), 1e-3);
}

// The disc of the table of exact curvatures; its signs are those of a sphere of negative curvature.
const Profile tabulated{0.2072, 2.0026, -1.1228};

TEST(Bending, SmoothDiscAgreesWithTheTable)
{
  const Table table("09c_biconcave_exact_curvature_force.csv");
  const SmoothDisc smooth{tabulated};
  for (int row = 0; row < table.rows(); ++row) {
    const double angle = std::acos(
        std::copysign(std::sqrt(1 - std::pow(table.number(row, "x"), 2)), table.number(row, "z")));
    EXPECT_NEAR(smooth.curvature(angle).mean, -table.number(row, "H"), 2e-4);
    EXPECT_NEAR(smooth.curvature(angle).gaussian, table.number(row, "K"), 6e-4);
    EXPECT_NEAR(smooth.bending_force(angle), -table.number(row, "force"), 0.1);
  }
}

/// Root mean square error of the normal force per area, in bands of latitude and vertex by vertex, without the
/// vertices within two edges of the twelve where five triangles meet: there it does not converge.
struct ForceError {
  double bands = 0, vertices = 0, exact = 0;

  explicit ForceError(int frequency)
  {
    const Mesh mesh = disc(frequency, tabulated);
    const rbc::SurfaceTemplate shape = mesh.surface();
    const std::vector<double> areas = vertex_areas(shape);
    const Result result = evaluate(shape, bending(1, 0), mesh.vertices);

    std::vector<char> excluded(shape.size());
    for (int v = 0; v < shape.size(); ++v) {
      if (shape.neighbours[v].size() != 5) continue;
      for (int w : shape.neighbours[v])
        for (int u : shape.neighbours[w]) excluded[u] = excluded[w] = 1;
    }

    struct Band {
      double force = 0, exact = 0, area = 0;
    };
    std::array<Band, 16> band;
    double total_area = 0;
    for (int v = 0; v < shape.size(); ++v) {
      if (excluded[v]) continue;
      const double angle = std::asin(std::min(1.0, mesh.vertices[v].head<2>().norm()));
      const double expected = SmoothDisc{tabulated}.bending_force(angle);
      const double force = result.force[v].dot(result.volume_gradient[v].normalized());
      Band &home = band[std::min(15, static_cast<int>(angle / (pi / 2) * 16))];
      home.force += force;
      home.exact += areas[v] * expected;
      home.area += areas[v];
      vertices += areas[v] * std::pow(force / areas[v] - expected, 2);
      total_area += areas[v];
    }
    for (const Band &b : band) {
      if (b.area == 0) continue;
      bands += std::pow(b.force - b.exact, 2) / b.area;
      exact += std::pow(b.exact, 2) / b.area;
    }
    for (double *square : {&bands, &vertices, &exact}) *square = std::sqrt(*square / total_area);
  }
};

TEST(Bending, NormalForceOnBandsOfTheDiscIsOfSecondOrder)
{
  double last = 0;
  for (int frequency : {8, 16, 32}) {
    const ForceError error(frequency);
    std::cout << "force per area, frequency " << frequency << ": error of bands " << error.bands
              << ", of vertices " << error.vertices << ", of " << error.exact << '\n';
    if (frequency > 8) {
      EXPECT_GT(order(last, error.bands), 1.7);
    }
    EXPECT_LT(error.vertices, 0.3 * error.exact);
    last = error.bands;
  }
  EXPECT_LT(last, 2);
}

}    // namespace
