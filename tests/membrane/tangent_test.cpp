// Forces and their derivatives against automatic differentiation of energies written down anew: at
// large stretch, with needles and with a triangle pressed flat.

#include "hyper_dual.h"
#include "test_support.h"

#include <functional>

using namespace test;

namespace {

using Number = HyperDual;
using Vector = std::array<Number, 3>;

Vector operator-(const Vector &x, const Vector &y)
{
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

Number dot(const Vector &x, const Vector &y)
{
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

Vector cross(const Vector &x, const Vector &y)
{
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

Number norm(const Vector &x)
{
  return sqrt(dot(x, x));
}

using Density = std::function<Number(const Number &i1, const Number &J)>;

/// From the invariants of the deformation gradient between the triangles laid in their planes.
Number sheet_energy(const rbc::SurfaceTemplate &shape, const std::vector<Vector> &x,
                    const Density &density)
{
  Number energy;
  for (const auto &[i, j, k] : shape.triangles) {
    const Vec3 E1 = shape.vertices[j] - shape.vertices[i],
               E2 = shape.vertices[k] - shape.vertices[i];
    const double base = E1.norm(), foot = E1.dot(E2) / base, height = E1.cross(E2).norm() / base;
    const Vector e1 = x[j] - x[i], e2 = x[k] - x[i];
    // Columns of the gradient: along the base, and across.
    const Vector along{e1[0] / base, e1[1] / base, e1[2] / base};
    Vector across;
    for (int d = 0; d < 3; ++d) across[d] = (e2[d] - foot * along[d]) / height;
    energy =
        energy + base * height / 2 *
                     density(dot(along, along) + dot(across, across), norm(cross(along, across)));
  }
  return energy;
}

Number turn(const rbc::Hinge &hinge, const std::vector<Vector> &x)
{
  const Vector edge = x[hinge.b] - x[hinge.a];
  const Vector left = cross(edge, x[hinge.c] - x[hinge.a]);
  const Vector right = cross(x[hinge.d] - x[hinge.a], edge);
  return atan_of_ratio(dot(cross(left, right), edge) / norm(edge), dot(left, right));
}

Number dihedral_energy(const rbc::SurfaceTemplate &shape, const std::vector<Vector> &x)
{
  const std::vector<Vector> rest = [&] {
    std::vector<Vector> vertices;
    for (const Vec3 &v : shape.vertices) vertices.push_back({v[0], v[1], v[2]});
    return vertices;
  }();
  Number energy;
  for (const rbc::Hinge &hinge : shape.hinges)
    energy = energy + 2 / std::sqrt(3.0) * (Number(1) - cos(turn(hinge, x) - turn(hinge, rest)));
  return energy;
}

constexpr double c0 = -0.7;

Number helfrich_energy(const rbc::SurfaceTemplate &shape, const std::vector<Vector> &x)
{
  std::vector<Number> area(shape.vertex_count()), integral(shape.vertex_count());
  for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
    const auto &[i, j, k] = shape.triangles[t];
    const Number of_triangle = 0.5 * norm(cross(x[j] - x[i], x[k] - x[i]));
    for (int c = 0; c < 3; ++c)
      area[shape.triangles[t][c]] =
          area[shape.triangles[t][c]] + shape.corner_share[c][t] * of_triangle;
  }
  for (const rbc::Hinge &hinge : shape.hinges)
    for (int v : {hinge.a, hinge.b})
      integral[v] = integral[v] + 0.25 * norm(x[hinge.b] - x[hinge.a]) * turn(hinge, x);
  Number energy;
  for (int v = 0; v < shape.vertex_count(); ++v) {
    const Number excess = integral[v] / area[v] - c0 / 2;
    energy = energy + 2 * excess * excess * area[v];
  }
  return energy;
}

struct Case {
  rbc::MembraneParameters parameters;
  std::function<Number(const rbc::SurfaceTemplate &, const std::vector<Vector> &)> energy;
};

Case sheet(const rbc::SheetLaw &law, const Density &density)
{
  Case sheet;
  sheet.parameters.law = law;
  sheet.energy = [=](const auto &shape, const auto &x) { return sheet_energy(shape, x, density); };
  return sheet;
}

Case bending(rbc::BendingForm form)
{
  Case bending;
  bending.parameters.law = rbc::Skalak(0, 0);
  bending.parameters.bending = 1;
  bending.parameters.bending_form = form;
  bending.parameters.reference_curvature = form == rbc::BendingForm::dihedral;
  bending.parameters.spontaneous_curvature = c0;
  bending.energy = form == rbc::BendingForm::dihedral ? dihedral_energy : helfrich_energy;
  return bending;
}

const std::map<std::string, Case> cases{
    {"NeoHookean", sheet(rbc::NeoHookean(2), [](auto i1, auto J) { return i1 + 1 / (J * J) - 3; })},
    {"MooneyRivlin", sheet(rbc::MooneyRivlin(30, 70, 0.01),
                           [](auto i1, auto J) {
                             return 0.3 * (i1 + 1 / (J * J) - 3) + 0.7 * (J * J + i1 / (J * J) - 3);
                           })},
    {"Skalak", sheet(rbc::Skalak(4, 3),
                     [](auto i1, auto J) {
                       const auto I1 = i1 - 2, I2 = J * J - 1;
                       return I1 * I1 + 2 * I1 - 2 * I2 + 3 * I2 * I2;
                     })},
    {"Helfrich", bending(rbc::BendingForm::helfrich)},
    {"Dihedral", bending(rbc::BendingForm::dihedral)}};

/// An end of an edge moved along it to a fiftieth of its length: needles with an angle of about 1
/// degree on both sides.
Vertices with_needles(Vertices x, const rbc::Hinge &hinge)
{
  x[hinge.a] = x[hinge.b] + 0.02 * (x[hinge.a] - x[hinge.b]);
  return x;
}

double smallest_angle(const Mesh &mesh)
{
  double smallest = pi;
  for (const auto &t : mesh.triangles)
    for (int c = 0; c < 3; ++c) {
      const Vec3 &at = mesh.vertices[t[c]];
      const Vec3 e1 = mesh.vertices[t[(c + 1) % 3]] - at, e2 = mesh.vertices[t[(c + 2) % 3]] - at;
      smallest = std::min(smallest, std::atan2(e1.cross(e2).norm(), e1.dot(e2)));
    }
  return smallest * 180 / pi;
}

class Tangent : public testing::TestWithParam<std::string> {
 protected:
  /// The force is minus the gradient of the energy, and the difference of forces along a direction
  /// minus the product of the matrix of second derivatives with it.
  void expect(const Mesh &rest, const Vertices &x) const
  {
    const rbc::SurfaceTemplate shape = rest.surface();
    const Case &that = cases.at(GetParam());
    rbc::MembraneModel model(shape, that.parameters);
    Random random(3);
    Vertices direction;
    for (std::size_t v = 0; v < x.size(); ++v) direction.push_back(random.vector(-1, 1));

    Vertices gradient(x.size()), product(x.size());
    for (std::size_t v = 0; v < x.size(); ++v)
      for (int d = 0; d < 3; ++d) {
        std::vector<Vector> dual(x.size());
        for (std::size_t w = 0; w < x.size(); ++w)
          for (int c = 0; c < 3; ++c)
            dual[w][c] = {x[w][c], w == v && c == d ? 1.0 : 0.0, direction[w][c], 0};
        const Number energy = that.energy(shape, dual);
        gradient[v][d] = energy.a;
        product[v][d] = energy.ab;
      }

    const auto force = [&](double step) {
      Vertices moved = x;
      for (std::size_t v = 0; v < x.size(); ++v) moved[v] += step * direction[v];
      return evaluate(model, shape, moved).force;
    };
    const double step = 3e-6;
    const Vertices force_at = force(0), up = force(step), down = force(-step),
                   far_up = force(2 * step), far_down = force(-2 * step);
    Vertices minus_force, difference;
    double largest_force = 0, largest_product = 0;
    for (std::size_t v = 0; v < x.size(); ++v) {
      minus_force.push_back(-force_at[v]);
      difference.push_back((8 * (down[v] - up[v]) - (far_down[v] - far_up[v])) / (12 * step));
      largest_force = std::max(largest_force, force_at[v].norm());
      largest_product = std::max(largest_product, product[v].norm());
    }
    EXPECT_LT(largest_difference(minus_force, gradient), 1e-13 * largest_force);
    EXPECT_LT(largest_difference(difference, product), 2e-9 * largest_product);
  }

  const Mesh sphere_ = icosphere(2);
};

TEST_P(Tangent, OfAWavedSphere)
{
  expect(sphere_, waved(sphere_.vertices, 2));
}

TEST_P(Tangent, AtStretchThree)
{
  for (const Vec3 &stretch :
       {Vec3(3, 1 / std::sqrt(3), 1 / std::sqrt(3)), Vec3(3, 1, 1), Vec3(3, 3, 3)})
    expect(sphere_, transformed(waved(sphere_.vertices, 2),
                                [&](const Vec3 &x) { return Vec3(x.cwiseProduct(stretch)); }));
}

TEST_P(Tangent, WithNeedlesOfOneDegreeAtRest)
{
  Mesh rest = sphere_;
  rest.vertices = with_needles(rest.vertices, sphere_.surface().hinges[7]);
  EXPECT_NEAR(smallest_angle(rest), 1, 0.2);
  expect(rest, waved(rest.vertices, 2));
}

TEST_P(Tangent, DrawnIntoNeedlesOfOneDegree)
{
  const Mesh deformed{with_needles(waved(sphere_.vertices, 2), sphere_.surface().hinges[7]),
                      sphere_.triangles};
  EXPECT_NEAR(smallest_angle(deformed), 1, 0.25);
  expect(sphere_, deformed.vertices);
}

TEST_P(Tangent, PressedToATwentiethOfTheArea)
{
  const auto &[i, j, k] = sphere_.triangles[9];
  Vertices x = sphere_.vertices;
  x[i] += 0.95 * ((x[j] + x[k]) / 2 - x[i]);
  const auto area = [i = i, j = j, k = k](const Vertices &at) {
    return (at[j] - at[i]).cross(at[k] - at[i]).norm();
  };
  EXPECT_NEAR(area(x) / area(sphere_.vertices), 0.05, 1e-12);
  expect(sphere_, x);
}

INSTANTIATE_TEST_SUITE_P(, Tangent,
                         testing::Values("NeoHookean", "MooneyRivlin", "Skalak", "Helfrich",
                                         "Dihedral"));

}    // namespace
