// Cells shared by several owners, and the search for inverted triangles.

#include "test_support.h"

#include <limits>

using namespace test;

namespace {

using Owners = std::vector<int>;    // of each vertex

Owners random_owners(int vertices, int count, unsigned seed)
{
  Random random(seed);
  Owners owners;
  for (int v = 0; v < vertices; ++v) owners.push_back(random.below(count));
  return owners;
}

Owners slabs(const Vertices &x, int count)
{
  Owners owners;
  for (const Vec3 &vertex : x)
    owners.push_back(
        std::clamp(static_cast<int>((vertex[0] + 0.3 * vertex[2] + 1) / 2 * count), 0, count - 1));
  return owners;
}

/// By planes through the middle, and one vertex for itself.
Owners octants_and_an_island(const Vertices &x)
{
  Owners owners;
  for (const Vec3 &vertex : x) owners.push_back((vertex[0] > 0) + 2 * (vertex[1] > 0.1));
  owners[x.size() / 3] = 4;
  return owners;
}

std::vector<Owners> splits(const Vertices &x)
{
  const int size = static_cast<int>(x.size());
  return {random_owners(size, 2, 1), random_owners(size, 5, 2), slabs(x, 2), slabs(x, 5),
          octants_and_an_island(x)};
}

std::vector<char> owned_by(const Owners &owners, int owner)
{
  std::vector<char> owned;
  for (int o : owners) owned.push_back(o == owner);
  return owned;
}

int count(const Owners &owners)
{
  return 1 + *std::max_element(owners.begin(), owners.end());
}

/// Vertices within some edges of those marked.
std::vector<char> around(const rbc::SurfaceTemplate &shape, std::vector<char> marked, int edges)
{
  for (int n = 0; n < edges; ++n) {
    const std::vector<char> before = marked;
    for (const rbc::Hinge &hinge : shape.hinges) {
      if (before[hinge.a]) marked[hinge.b] = 1;
      if (before[hinge.b]) marked[hinge.a] = 1;
    }
  }
  return marked;
}

class Parts : public testing::TestWithParam<std::string> {};

TEST_P(Parts, GiveTheForcesAndSumToTheEnergiesOfTheWhole)
{
  const rbc::MembraneParameters parameters = each_energy().at(GetParam());
  const rbc::SurfaceTemplate shape = disc(4).surface();
  const Vertices x = waved(shape.vertices, 4);
  const Result whole = evaluate(shape, parameters, x);
  const double scale = total_norm(whole.force) / shape.vertex_count();
  rbc::MembraneModel model(shape, parameters);    // the same for all parts, in turn
  rbc::VolumeGradient of_volume(shape);
  const double unknown = std::numeric_limits<double>::quiet_NaN();

  for (const Owners &owners : splits(x)) {
    rbc::AreaVolume size;
    double by_gradient = 0;
    rbc::MembraneEnergy energy;
    for (int owner = 0; owner < count(owners); ++owner) {
      const bool bends = parameters.bending > 0;
      const auto elements = rbc::CellElements::part(shape, owned_by(owners, owner), bends);
      // Positions further away than two edges, one without bending, are not there to be read.
      const std::vector<char> known = around(shape, elements.owned, bends ? 2 : 1);
      Vertices near = x;
      for (int v = 0; v < shape.vertex_count(); ++v)
        if (!known[v]) near[v].fill(unknown);
      Vertices force(x.size()), gradient(x.size());
      for (int t : elements.triangles)
        for (int v : shape.triangles[t]) ASSERT_TRUE(known[v]);
      model.set_cell(elements, near);
      const rbc::AreaVolume share = model.area_and_volume();
      const double volume = of_volume.find(elements, near.data(), gradient.data());
      const rbc::MembraneEnergy part = model.forces(whole.size, force);
      size.area += share.area;
      size.volume += share.volume;
      by_gradient += volume;
      energy.sheet += part.sheet;
      energy.bending += part.bending;
      energy.area += part.area;
      energy.volume += part.volume;
      for (int v = 0; v < shape.vertex_count(); ++v) {
        if (!elements.owned[v]) continue;
        ASSERT_TRUE((force[v] - whole.force[v]).norm() < 1e-12 * scale);
        ASSERT_TRUE((gradient[v] - whole.volume_gradient[v]).norm() < 1e-15);
      }
    }
    EXPECT_NEAR(size.area, whole.size.area, 1e-13 * whole.size.area);
    EXPECT_NEAR(size.volume, whole.size.volume, 1e-13 * whole.size.volume);
    EXPECT_NEAR(by_gradient, whole.size.volume, 1e-13 * whole.size.volume);
    EXPECT_NEAR(energy.sheet, whole.energy.sheet, 1e-13 * whole.energy.sheet);
    EXPECT_NEAR(energy.bending, whole.energy.bending, 1e-13 * whole.energy.bending);
    EXPECT_NEAR(energy.area, whole.energy.area, 1e-13 * whole.energy.area);
    EXPECT_NEAR(energy.volume, whole.energy.volume, 1e-13 * whole.energy.volume);
  }
}

INSTANTIATE_TEST_SUITE_P(, Parts, testing::ValuesIn(names_of_energies()), test_name);

TEST(Measure, VolumeGradientIsThatOfTheVolume)
{
  const rbc::SurfaceTemplate shape = disc(4).surface();
  const auto all = rbc::CellElements::whole(shape);
  rbc::MembraneModel model(shape, {});
  Vertices x = waved(shape.vertices, 8), gradient(x.size());
  const auto volume = [&] {
    model.set_cell(all, x);
    return model.area_and_volume().volume;
  };
  rbc::VolumeGradient(shape).find(all, x.data(), gradient.data());
  for (int v = 0; v < shape.vertex_count(); ++v)
    for (int d = 0; d < 3; ++d) {
      // The volume is linear in each coordinate.
      const double at = x[v][d];
      x[v][d] = at + 0.5;
      const double above = volume();
      x[v][d] = at - 0.5;
      EXPECT_NEAR(gradient[v][d], above - volume(), 1e-14);
      x[v][d] = at;
    }
}

/// A corner of a triangle pushed through the middle of the opposite edge.
Vertices inverted(const rbc::SurfaceTemplate &shape, Vertices x, int triangle)
{
  const auto &[i, j, k] = shape.triangles[triangle];
  x[i] += 1.2 * ((x[j] + x[k]) / 2 - x[i]);
  return x;
}

std::string find_flaw(const rbc::SurfaceTemplate &shape, const Vertices &x)
{
  rbc::MembraneModel model(shape, {});
  const auto all = rbc::CellElements::whole(shape);
  model.set_cell(all, x);
  return model.find_flaw();
}

std::string is_inverted(int triangle)
{
  return "triangle " + std::to_string(triangle + 1) + " is inverted";
}

TEST(Flaw, EveryInvertedTriangleIsFound)
{
  const rbc::SurfaceTemplate shape = disc(8).surface();
  for (int t = 0; t < static_cast<int>(shape.triangles.size()); ++t)
    ASSERT_EQ(find_flaw(shape, inverted(shape, shape.vertices, t)), is_inverted(t));
}

TEST(Flaw, HealthyCellsHaveNone)
{
  for (const Mesh &mesh : {icosphere(1), icosphere(4), disc(4), disc(8), disc(16)}) {
    const rbc::SurfaceTemplate shape = mesh.surface();
    EXPECT_EQ(find_flaw(shape, shape.vertices), "");
    for (unsigned seed = 0; seed < 20; ++seed)
      EXPECT_EQ(find_flaw(shape, waved(shape.vertices, seed)), "");
    for (int d = 0; d < 3; ++d)
      for (double stretch : {0.33, 3.0}) {
        Vertices x = shape.vertices;
        for (Vec3 &vertex : x) vertex[d] *= stretch;
        EXPECT_EQ(find_flaw(shape, x), "");
        for (Vec3 &vertex : x) vertex[(d + 1) % 3] += vertex[d];    // and sheared
        EXPECT_EQ(find_flaw(shape, x), "");
      }
  }
}

TEST(Flaw, SharpTipsAreHealthy)
{
  // A tall pyramid over a flat triangle: one side is folded over two of its edges by 150 degrees,
  // by 90 over the third.
  const Vertices x = {{-1, 0, 0}, {1, 0, 0}, {0, 0.577, 0}, {0, 0.19, 5}};
  EXPECT_EQ(find_flaw(rbc::SurfaceTemplate(x, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}), x),
            "");
}

/// A bipyramid over a square, pressed flat: at its rim the triangles are folded by twice the angle
/// whose tangent is the height over the distance of the rim from the centre.
TEST(Flaw, FoldsBeyond175DegreesAreFound)
{
  const std::vector<std::array<int, 3>> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (double fold : {100.0, 150.0, 174.9, 175.1, 179.0}) {
    const double pi = std::acos(-1.0), slope = std::tan((180 - fold) / 2 * pi / 180);
    const double height = slope / std::sqrt(2.0);
    const Vertices x = {{1, 0, 0},  {-1, 0, 0},     {0, 1, 0},
                        {0, -1, 0}, {0, 0, height}, {0, 0, -height}};
    const std::string flaw = find_flaw(rbc::SurfaceTemplate(x, triangles), x);
    if (fold < 175)
      EXPECT_EQ(flaw, "") << fold;
    else
      EXPECT_NE(flaw.find("folded onto each other"), std::string::npos) << fold;
  }
}

/// A pyramid over a triangle, which is folded against all others by half a turn less the angle
/// whose tangent is the height over the radius of the inscribed circle.
TEST(Flaw, TrianglesFoldedByMoreThan120DegreesAgainstAllNeighborsAreInverted)
{
  const double pi = std::acos(-1.0), root = std::sqrt(3.0);
  for (double fold : {95.0, 109.5, 119.9, 120.1, 150.0}) {
    const double height = 0.5 * std::tan((180 - fold) * pi / 180);
    const Vertices x = {{1, 0, 0}, {-0.5, -root / 2, 0}, {-0.5, root / 2, 0}, {0, 0, height}};
    const rbc::SurfaceTemplate shape(x, {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}});
    EXPECT_EQ(find_flaw(shape, x), fold < 120 ? "" : is_inverted(0)) << fold;
  }
}

TEST(Flaw, InvertedTriangleIsFoundByAnOwnerOfTwoOfItsCorners)
{
  const rbc::SurfaceTemplate shape = disc(4).surface();
  for (bool bending : {false, true})
    for (const Owners &owners : splits(shape.vertices)) {
      std::vector<rbc::CellElements> parts;
      parts.reserve(count(owners));
      for (int owner = 0; owner < count(owners); ++owner)
        parts.push_back(rbc::CellElements::part(shape, owned_by(owners, owner), bending));
      rbc::MembraneModel model(shape, {});
      for (int t = 0; t < static_cast<int>(shape.triangles.size()); ++t) {
        const Vertices x = inverted(shape, shape.vertices, t);
        const auto &[i, j, k] = shape.triangles[t];
        for (int owner = 0; owner < count(owners); ++owner) {
          const int corners = (owners[i] == owner) + (owners[j] == owner) + (owners[k] == owner);
          model.set_cell(parts[owner], x);
          const std::string found = model.find_flaw();
          ASSERT_TRUE(found == is_inverted(t) || corners < (bending ? 1 : 2)) << found;
          if (corners >= (bending ? 1 : 2)) {
            ASSERT_EQ(found, is_inverted(t));
          }
        }
      }
    }
}

}    // namespace
