// Both forms of bending: energies of spheres, tubes and the biconcave disc, normal forces on the
// disc.

#include "disc_force.h"

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

rbc::MembraneParameters dihedral(double kappa, double c0)
{
  rbc::MembraneParameters parameters = bending(kappa, c0);
  parameters.bending_form = rbc::BendingForm::dihedral;
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

TEST(Bending, EnergyOfASphereOf2562VerticesIsWithinOnePercent)
{
  EXPECT_NEAR(sphere_energy(16, 1, 1, 0) / (8 * pi), 1, 0.01);
}

/// The angle between the normals of triangles inscribed in the unit sphere: each is turned from
/// their common edge by the height of its circumcentre over the edge, over the distance of the edge
/// from the centre of the sphere.
double angle_on_sphere(const Mesh &mesh, const rbc::Hinge &hinge)
{
  const Vec3 &a = mesh.vertices[hinge.a], &b = mesh.vertices[hinge.b];
  const double length = (b - a).norm(), distance = (a + b).norm() / 2;
  double angle = 0;
  for (int corner : {hinge.c, hinge.d}) {
    const Vec3 to_a = a - mesh.vertices[corner], to_b = b - mesh.vertices[corner];
    const double height = length / 2 * to_a.dot(to_b) / to_a.cross(to_b).norm();
    angle += std::asin(height / distance);
  }
  return angle;
}

TEST(Bending, DihedralEnergyOfASphereIsThatOfItsMesh)
{
  double last = 0;
  for (int frequency : {4, 8, 16, 32}) {
    const Mesh mesh = icosphere(frequency);
    const rbc::SurfaceTemplate shape = mesh.surface();
    double expected = 0;
    for (const rbc::Hinge &hinge : shape.hinges)
      expected += 2 / std::sqrt(3) * (1 - std::cos(angle_on_sphere(mesh, hinge)));
    const double energy = evaluate(shape, dihedral(1, 0), mesh.vertices).energy.bending;
    EXPECT_NEAR(energy, expected, 1e-10 * expected);
    // Not of the Helfrich energy: equilateral triangles would give 8 pi - 4/3 * 4 pi.
    EXPECT_GT(energy / (8 * pi / 3), 1.01);
    EXPECT_LT(energy / (8 * pi), 0.5);
    last = energy;
  }
  std::cout << "dihedral energy of a sphere over 8 pi/3: " << last / (8 * pi / 3) << '\n';
}

TEST(Bending, DihedralSphereOfItsSpontaneousCurvatureIsAtRestToFourthOrder)
{
  const double radius = 2.5;
  double last = 0;
  for (int frequency : {4, 8, 16, 32}) {
    Mesh mesh = icosphere(frequency);
    for (Vec3 &x : mesh.vertices) x *= radius;
    const double energy =
        evaluate(mesh.surface(), dihedral(1, 2 / radius), mesh.vertices).energy.bending;
    if (frequency > 4) {
      EXPECT_NEAR(order(last, energy), 4, 0.1);
    }
    last = energy;
  }
}

/// Tube of unit radius of equilateral triangles, `around` of them around it, with pointed ends.
/// Rows of edges run around the tube, or along it.
Mesh tube(int around, int rows, bool along)
{
  const double step = 2 * pi / around;
  const auto chord = [](double angle) { return 2 * std::sin(angle / 2); };
  const double edge = along ? chord(step) / std::sqrt(0.75) : chord(step);
  const double height = along ? edge : std::sqrt(edge * edge - std::pow(chord(step / 2), 2));

  // Place (i, j) is in the middle between the places of the rows j - 1 and j + 1.
  Welder welder;
  const auto vertex = [&](int i, int j) {
    const double shifted = i + 0.5 * (std::abs(j) % 2);
    const double angle = step * (along ? j : shifted), z = height * (along ? shifted : j);
    return welder.index({std::cos(angle), std::sin(angle), z});
  };
  const auto add = [&](int a, int b, int c) {
    if (along) std::swap(b, c);
    welder.mesh.triangles.push_back({a, b, c});
  };
  for (int i = 0; i < (along ? rows : around); ++i)
    for (int j = 0; j < (along ? around : rows); ++j) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                d = vertex(i, j + 1);
      if (j % 2 == 0) {
        add(a, b, d);
        add(b, c, d);
      } else {
        add(a, b, c);
        add(a, c, d);
      }
    }
  const int bottom = welder.index({0, 0, -1}), top = welder.index({0, 0, height * rows + 1});
  for (int n = 0; n < around; ++n) {
    const auto end = [&](int at, int step) {
      return along ? vertex(at, n + step) : vertex(n + step, at);
    };
    welder.mesh.triangles.push_back({bottom, end(0, 1), end(0, 0)});
    welder.mesh.triangles.push_back({top, end(rows, 0), end(rows, 1)});
  }
  return welder.mesh;
}

TEST(Bending, EnergyOfATubeOfEquilateralTrianglesIsOfSecondOrderInBothForms)
{
  for (const rbc::MembraneParameters &parameters : {bending(0.7, 0), dihedral(0.7, 0)})
    for (bool along : {false, true}) {
      double last = 0;
      for (int around : {12, 24, 48, 96}) {
        // A tube of twice the rows has the same ends.
        double energy[2], length[2];
        for (int n : {0, 1}) {
          const Mesh mesh = tube(around, around * (n + 1) / 2, along);
          energy[n] = evaluate(mesh.surface(), parameters, mesh.vertices).energy.bending;
          length[n] = mesh.vertices[mesh.vertices.size() - 1][2];
        }
        const double exact = 0.7 / 2 * 2 * pi * (length[1] - length[0]);
        const double error = (energy[1] - energy[0]) / exact - 1;
        if (around > 12) {
          EXPECT_NEAR(order(last, error), 2, 0.1);
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
  const Table table("membrane/data/09c_biconcave_exact_curvature_force.csv");
  const SmoothDisc smooth{tabulated};
  for (int row = 0; row < table.rows(); ++row) {
    const double angle = std::acos(
        std::copysign(std::sqrt(1 - std::pow(table.number(row, "x"), 2)), table.number(row, "z")));
    EXPECT_NEAR(smooth.curvature(angle).mean, -table.number(row, "H"), 2e-4);
    EXPECT_NEAR(smooth.curvature(angle).gaussian, table.number(row, "K"), 6e-4);
    EXPECT_NEAR(smooth.bending_force(angle), -table.number(row, "force"), 0.1);
  }
}

TEST(Bending, NormalForceOnTheDiscIsOfSecondOrderInBandsAndInTheMedian)
{
  DiscForceError last;
  for (int frequency : {8, 16, 32, 64}) {
    const DiscForceError error(frequency, tabulated, bending(1, 0));
    std::cout << "force per area, frequency " << frequency << ": error of bands " << error.bands
              << ", median " << error.median << ", rms " << error.rms << ", largest "
              << error.largest << ", of " << error.exact << '\n';
    if (frequency > 8) {
      EXPECT_GT(order(last.bands, error.bands), 1.7);
      EXPECT_GT(order(last.median, error.median), 1.6);
    }
    last = error;
  }
  EXPECT_LT(last.bands, 0.01 * last.exact);
  EXPECT_LT(last.median, 0.01 * last.exact);
}

/// Of a closed shape with k_c = 1 and theta_c = 60 degrees.
double crease_energy(const Mesh &mesh, rbc::MembraneParameters parameters)
{
  const auto energy = [&] {
    return evaluate(mesh.surface(), parameters, mesh.vertices).energy.bending;
  };
  const double smooth = energy();
  parameters.crease = {1, 0.5};
  return energy() - smooth;
}

TEST(Crease, EnergyIsThatOfTheAnglesOfPlatonicSolids)
{
  // 6 edges, cosine -1/3
  const Mesh tetrahedron{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                         {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
  // 12 edges, cosine 1/3
  const Mesh octahedron{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (const auto &parameters : {bending(0.1, 0), dihedral(0.1, 0)}) {
    EXPECT_NEAR(crease_energy(tetrahedron, parameters), 6.25, 1e-12);
    EXPECT_NEAR(crease_energy(octahedron, parameters), 0.25, 1e-12);
    EXPECT_EQ(crease_energy(icosphere(1), parameters), 0) << "42 degrees";
  }
}

}    // namespace
