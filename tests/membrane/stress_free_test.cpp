// A stress-free shape apart from the shape of the cell, and a rest volume apart from its volume.

#include "membrane/membrane_tension.h"
#include "test_support.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <stdexcept>

using namespace test;

namespace {

/// A disc whose stress-free shape is a sphere of like area, with the same triangles.
struct DiscFromSphere {
  Mesh sphere = icosphere(4);
  rbc::SurfaceTemplate shape = disc(4).surface();

  DiscFromSphere()
  {
    for (Vec3 &x : sphere.vertices) x *= 0.85;
    shape.take_reference(sphere.surface());
  }
};

/// Principal stretches between two triangles, from the gradient of the map between their planes.
Eigen::Vector2d stretches(const std::array<Vec3, 3> &from, const std::array<Vec3, 3> &to)
{
  const auto flat = [](const std::array<Vec3, 3> &x) {
    const Vec3 e = x[1] - x[0], g = x[2] - x[0], along = e.normalized();
    Eigen::Matrix2d sides;
    sides << e.norm(), g.dot(along), 0, (g - g.dot(along) * along).norm();
    return sides;
  };
  const Eigen::Matrix2d gradient = flat(to) * flat(from).inverse();
  return Eigen::JacobiSVD<Eigen::Matrix2d>(gradient).singularValues();
}

double heron(const std::array<Vec3, 3> &x)
{
  const double a = (x[1] - x[0]).norm(), b = (x[2] - x[1]).norm(), c = (x[0] - x[2]).norm(),
               s = (a + b + c) / 2;
  return std::sqrt(s * (s - a) * (s - b) * (s - c));
}

TEST(StressFree, OwnShapeChangesNothing)
{
  const rbc::SurfaceTemplate plain = disc(4).surface();
  rbc::SurfaceTemplate same = plain;
  same.take_reference(disc(4).surface());
  const Vertices x = waved(plain.vertices, 3);
  for (const auto &[name, parameters] : each_energy()) {
    SCOPED_TRACE(name);
    const Result a = evaluate(plain, parameters, x), b = evaluate(same, parameters, x);
    EXPECT_EQ(a.energy.total(), b.energy.total());
    EXPECT_EQ(a.force, b.force);
  }
}

TEST(StressFree, EnergyOfTheCellIsThatOfItsStretches)
{
  const DiscFromSphere cell;
  rbc::MembraneParameters skalak, neo_hookean;
  skalak.law = rbc::Skalak(0.8, 5);
  skalak.local_area = 4;
  skalak.global_area = 3;
  skalak.volume = 2;
  skalak.bending = 0.3;
  neo_hookean.law = rbc::NeoHookean(1.3);
  double sheet = 0, area = 0, incompressible = 0;
  for (const auto &[i, j, k] : cell.shape.triangles) {
    const auto &p = cell.sphere.vertices, &q = cell.shape.vertices;
    const double rest = heron({p[i], p[j], p[k]});
    const Eigen::Vector2d s = stretches({p[i], p[j], p[k]}, {q[i], q[j], q[k]});
    const double a = s[0] * s[0], b = s[1] * s[1];
    const double I1 = a + b - 2, I2 = a * b - 1;
    sheet += rest * 0.8 / 4 * (I1 * I1 + 2 * I1 - 2 * I2 + 5 * I2 * I2);
    area += rest * 4 / 2 * (s[0] * s[1] - 1) * (s[0] * s[1] - 1);
    incompressible += rest * 1.3 / 2 * (a + b + 1 / (a * b) - 3);
  }
  const rbc::MembraneEnergy found = evaluate(cell.shape, skalak, cell.shape.vertices).energy;
  EXPECT_GT(sheet, 0.01);
  EXPECT_NEAR(found.sheet, sheet, 1e-12 * sheet);
  EXPECT_NEAR(found.area, area, 1e-12 * area) << "the cell's own area costs nothing";
  EXPECT_NEAR(evaluate(cell.shape, neo_hookean, cell.shape.vertices).energy.sheet, incompressible,
              1e-12 * incompressible);
  EXPECT_NEAR(found.volume, 0, 1e-28);
  EXPECT_NEAR(found.bending, 0, 1e-24);
}

TEST(StressFree, NoForceOfTheSheetInThatShape)
{
  const DiscFromSphere cell;
  for (const auto &[name, parameters] : each_energy()) {
    if (parameters.bending > 0 || parameters.global_area > 0 || parameters.volume > 0) continue;
    if (parameters.stretch.i1 < 2 && parameters.stretch.stiffness > 0)
      continue;    // sets in before
    SCOPED_TRACE(name);
    const double scale = total_norm(evaluate(cell.shape, parameters, cell.shape.vertices).force);
    const Result rest = evaluate(cell.shape, parameters, cell.sphere.vertices);
    EXPECT_LT(total_norm(rest.force), 1e-12 * scale);
    EXPECT_NEAR(rest.energy.total(), 0, 1e-12 * scale);
  }
}

TEST(StressFree, ForceIsMinusTheGradient)
{
  const DiscFromSphere cell;
  const Vertices start = waved(cell.shape.vertices, 11);
  for (const auto &[name, parameters] : each_energy()) {
    SCOPED_TRACE(name);
    rbc::MembraneModel model(cell.shape, parameters);
    model.set_rest_volume(1.2 * cell.shape.volume);
    const Vertices force = evaluate(model, cell.shape, start).force;
    double largest = 0;
    for (const Vec3 &f : force) largest = std::max(largest, f.norm());
    Vertices x = start;
    const double step = 2e-4;
    for (std::size_t v = 0; v < x.size(); v += 7)
      for (int d = 0; d < 3; ++d) {
        const auto energy = [&](double change) {
          x[v][d] = start[v][d] + change;
          return evaluate(model, cell.shape, x).energy.total();
        };
        const double near = energy(step) - energy(-step),
                     far = energy(2 * step) - energy(-2 * step);
        x[v][d] = start[v][d];
        EXPECT_NEAR(force[v][d], -(8 * near - far) / (12 * step), 1e-8 * largest);
      }
  }
}

TEST(StressFree, TensionIsThatOfTheStressFreeShape)
{
  // a sphere grown by l: T = Gs (1 - l^-6) of a neo-Hookean sheet, plus the local area term
  const DiscFromSphere cell;
  rbc::MembraneParameters parameters;
  parameters.law = rbc::NeoHookean(1.3);
  parameters.local_area = 0.7;
  const double l = 1.15;
  const Vertices x =
      transformed(cell.sphere.vertices, [&](const Vec3 &vertex) { return Vec3(l * vertex); });
  std::vector<double> tension;
  rbc::vertex_tension(cell.shape, parameters, x, tension);
  for (double t : tension) EXPECT_NEAR(t, 1.3 * (1 - std::pow(l, -6)) + 0.7 * (l * l - 1), 1e-12);
}

TEST(StressFree, OtherTrianglesAreRefused)
{
  const auto expect_refused = [](rbc::SurfaceTemplate shape, const Mesh &other,
                                 const std::string &reason) {
    const auto before = shape.reference[0].area;
    try {
      shape.take_reference(other.surface());
      FAIL() << "accepted, though it should say: " << reason;
    } catch (const std::invalid_argument &problem) {
      EXPECT_NE(std::string(problem.what()).find(reason), std::string::npos) << problem.what();
    }
    EXPECT_EQ(shape.reference[0].area, before);
  };
  const Mesh mesh = icosphere(2);
  expect_refused(mesh.surface(), icosphere(3), "it has 92 vertices, not 42");

  // two vertices change their numbers
  Mesh renamed = mesh;
  for (auto &corners : renamed.triangles)
    for (int &v : corners) v = v == 7 ? 30 : v == 30 ? 7 : v;
  std::swap(renamed.vertices[7], renamed.vertices[30]);
  std::size_t t = 0;
  while (renamed.triangles[t] == mesh.triangles[t]) ++t;
  const auto name = [&](const Mesh &of) {
    std::string text;
    for (int v : of.triangles[t]) text += (text.empty() ? "" : "-") + std::to_string(v + 1);
    return text;
  };
  expect_refused(mesh.surface(), renamed,
                 "its triangle " + name(renamed) + " stands in place of " + name(mesh));
}

TEST(RestVolume, EnergyAndPressure)
{
  const rbc::SurfaceTemplate shape = icosphere(4).surface();
  rbc::MembraneParameters parameters;
  parameters.law = rbc::Skalak(0, 0);
  parameters.volume = 6;
  rbc::MembraneModel model(shape, parameters);
  model.set_rest_volume(0.8 * shape.volume);
  const Result result = evaluate(model, shape, shape.vertices);
  EXPECT_NEAR(result.energy.total(), 6. / 2 * 0.2 * 0.2 / 0.8 * shape.volume, 1e-13);
  for (std::size_t v = 0; v < shape.vertices.size(); ++v)
    EXPECT_LT((result.force[v] + 6 * 0.25 * result.volume_gradient[v]).norm(), 1e-14);
}

}    // namespace
