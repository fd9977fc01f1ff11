// A stream of cells: its account against integrals of rates, the places of new cells against all
// pairs of triangles and against uniform distributions.

#include "../geometry/test_support.h"
#include "geometry/triangle_distance.h"
#include "packing/cell_placement.h"
#include "packing/stream_ledger.h"
#include "packing/surface_gap.h"

#include <cmath>

using namespace test;
using rbc::CellPlacement;
using rbc::StreamLedger;
using rbc::SurfaceTemplate;

namespace {

TEST(StreamLedger, VolumesAreIntegralsOfWhatPassesForwards)
{
  // piecewise linear: inlet 2 -> 4 -> -4 -> -1, outlets a constant and the rest
  StreamLedger ledger(0.3, 2);
  ledger.start(2, {1, 1});
  ledger.pass(0.5, 4, {1, 3});
  ledger.pass(2, -4, {1, -5});
  ledger.pass(1, -1, {1, -2});
  EXPECT_NEAR(ledger.inlet().volume, 1.5 + 2, 1e-14);
  EXPECT_NEAR(ledger.outlet(0).volume, 3.5, 1e-14);
  EXPECT_NEAR(ledger.outlet(1).volume, 1 + 0.5 * 3 * 2 * 3.0 / 8, 1e-14);
  EXPECT_NEAR(ledger.left().volume, ledger.outlet(0).volume + ledger.outlet(1).volume, 1e-14);
}

TEST(StreamLedger, CellsFollowTheVolumeWithinHalfACell)
{
  const double hematocrit = 0.37, cell = 94.1;
  StreamLedger ledger(hematocrit, 1);
  ledger.set_cell_volume(cell);
  Random random(3);
  double volume = 0, rate = 7, entered = 0;
  ledger.start(rate, {rate});
  for (int step = 0; step < 5000; ++step) {
    const double dt = random.between(0.1, 3), next = random.between(0, 20);
    ledger.pass(dt, next, {next});
    volume += dt * (rate + next) / 2;
    rate = next;
    const int whole = static_cast<int>(std::floor(ledger.owed() + 0.5));
    ledger.let_in(whole);
    entered += whole;
    ASSERT_LE(std::abs(entered - hematocrit * volume / cell), 0.5 + 1e-9);
  }
  EXPECT_GT(entered, 100);
  EXPECT_NEAR(ledger.inlet().hematocrit(), hematocrit, 0.5 * cell / volume + 1e-12);
  EXPECT_EQ(ledger.inlet().cells, entered);
}

TEST(StreamLedger, CellsThatFoundNoRoomStayOwed)
{
  StreamLedger ledger(0.5, 0);
  ledger.set_cell_volume(2);
  ledger.pass(10, 4, {});
  EXPECT_EQ(ledger.owed(), 10);
  ledger.let_in(4);
  EXPECT_EQ(ledger.owed(), 6);
  ledger.let_in(7);
  EXPECT_EQ(ledger.owed(), -1);
}

TEST(StreamLedger, CellsThatLeftCountWithTheirVolume)
{
  StreamLedger ledger(0.5, 2);
  ledger.set_cell_volume(2);
  ledger.pass(1, 10, {4, 6});
  ledger.let_out(1);
  ledger.let_out(1);
  ledger.let_out(0);
  EXPECT_EQ(ledger.outlet(0).cells, 1);
  EXPECT_NEAR(ledger.outlet(0).hematocrit(), 2.0 / 4, 1e-15);
  EXPECT_NEAR(ledger.outlet(1).hematocrit(), 4.0 / 6, 1e-15);
  EXPECT_NEAR(ledger.left().hematocrit(), 6.0 / 10, 1e-15);
}

/// The volume of a run is that of its own rates, whatever those of the run before were.
TEST(StreamLedger, RatesMayJumpBetweenRuns)
{
  StreamLedger ledger(0.2, 1);
  ledger.start(1, {2});
  ledger.pass(3, 1, {2});
  ledger.start(7, {4});
  ledger.pass(2, 7, {4});
  ledger.start(0, {0});
  ledger.pass(5, 0, {0});
  EXPECT_NEAR(ledger.inlet().volume, 3 * 1 + 2 * 7, 1e-14);
  EXPECT_NEAR(ledger.outlet(0).volume, 3 * 2 + 2 * 4, 1e-14);
}

TEST(StreamLedger, GoesOnFromItsState)
{
  StreamLedger one(0.2, 1), other(0.2, 1);
  for (StreamLedger *ledger : {&one, &other}) ledger->set_cell_volume(3);
  one.start(1, {2});
  one.pass(0.7, 5, {6});
  one.let_in(1);
  EXPECT_TRUE(other.restore(one.state()));
  for (StreamLedger *ledger : {&one, &other}) {
    ledger->start(5 * (1 + 1e-12), {6});    // known already
    ledger->pass(1.3, 9, {8});
    ledger->let_out(0);
  }
  EXPECT_EQ(one.state(), other.state());
  EXPECT_FALSE(StreamLedger(0.2, 2).restore(one.state()));
}

/// A block of any size.
class Block : public rbc::Enclosure {
 public:
  Block(Vec3 lo, Vec3 length) : lo_(std::move(lo)), length_(std::move(length)) {}

  bool contains(const Vec3 &x) const override
  {
    return ((x - lo_).array() >= 0).all() && ((x - lo_).array() <= length_.array()).all();
  }
  Vec3 inward(const Vec3 &, double) const override { return Vec3::Zero(); }

 private:
  Vec3 lo_, length_;
};

Vertices vertices_at(const SurfaceTemplate &shape, const CellPlacement::Place &place)
{
  Vertices vertices;
  for (const Vec3 &x : shape.vertices) vertices.push_back(place.centre + place.rotation * x);
  return vertices;
}

rbc::Triangle corners(const Vertices &x, const SurfaceTemplate::Corners &t)
{
  return {x[t[0]], x[t[1]], x[t[2]]};
}

double least_distance(const SurfaceTemplate &shape, const Vertices &a, const Vertices &b)
{
  double least = 1e9;
  for (const auto &s : shape.triangles)
    for (const auto &t : shape.triangles)
      if ((a[s[0]] - b[t[0]]).norm() < least + 2 * shape.longest_edge)
        least = std::min(least, rbc::distance(corners(a, s), corners(b, t)));
  return least;
}

TEST(CellPlacement, CellsKeepTheGapFromAllThatIsThere)
{
  const SurfaceTemplate shape = disc(3).surface();
  const double gap = 0.05;
  const Vec3 lo(-1, 2, 0.5), length(5, 5, 4);
  const Block block(lo, length);
  CellPlacement placement(shape, gap, 5);
  placement.confine(block, lo, length);

  // a cell that was deformed, and points
  Vertices bent = waved(shape.vertices, 3);
  for (Vec3 &x : bent) x += lo + length / 2;
  placement.avoid_surface({bent, &shape.triangles});
  const Vertices points{{0, 3, 1}, {1, 4, 2.5}, {3, 6, 3}};
  for (const Vec3 &point : points) placement.avoid_point(point);

  const rbc::RigidShape rigid(shape, 1);
  std::vector<Vertices> found{bent};
  for (int n = 0; n < 12; ++n) {
    const auto place = placement.find(20000);
    ASSERT_TRUE(place);
    const Vertices x = vertices_at(shape, *place);
    for (const Vec3 &vertex : x) EXPECT_TRUE(block.contains(vertex));
    for (const Vertices &other : found) EXPECT_GE(least_distance(shape, x, other), gap);
    const rbc::RigidCell cell{&rigid, place->centre, place->rotation, 1};
    for (const Vec3 &point : points) EXPECT_GE(surface_gap(point, cell, 1), gap);
    found.push_back(x);
  }
}

TEST(CellPlacement, TellsOfCellsOfAnyShapeWhetherTheyKeepAGap)
{
  const SurfaceTemplate shape = disc(3).surface();
  const double gap = 0.1;
  Random random(8);
  int fitted = 0;
  const int count = 60;
  for (int n = 0; n < count; ++n) {
    const Vertices there = waved(shape.vertices, n);
    const Matrix3 turn = random.rotation();
    const Vec3 apart = random.between(1, 2) * random.direction();
    Vertices here = waved(shape.vertices, n + count);
    for (Vec3 &x : here) x = apart + turn * x;
    const bool fits = least_distance(shape, here, there) >= gap;
    CellPlacement placement(shape, 2 * gap, 1);    // which does not count
    placement.avoid_surface({there, &shape.triangles});
    EXPECT_EQ(placement.fits(here, gap), fits);
    placement.avoid_surface({here, &shape.triangles});
    EXPECT_FALSE(placement.fits(here, gap)) << "a cell is there already";
    fitted += fits;
  }
  EXPECT_GT(fitted, count / 4);
  EXPECT_LT(fitted, 3 * count / 4);

  CellPlacement placement(shape, gap, 1);
  placement.avoid_point(shape.vertices[0] * 1.05);
  EXPECT_FALSE(placement.fits(shape.vertices, gap));
  placement.clear();
  placement.avoid_point(Vec3::Zero());    // inside
  EXPECT_FALSE(placement.fits(shape.vertices, gap));
  placement.clear();
  placement.avoid_point(shape.vertices[0] * 3);
  EXPECT_TRUE(placement.fits(shape.vertices, gap));
}

/// In an enclosure that is periodic along y: also from images, and from their own.
TEST(CellPlacement, CellsKeepTheGapFromImages)
{
  const SurfaceTemplate shape = disc(3).surface();
  const double gap = 0.05;
  const Vec3 lo(0, 0, 0), length(3, 3.5, 3), period(0, 3.5, 0);
  const Block block(lo - 9 * Vec3::UnitY(), length + 18 * Vec3::UnitY());
  CellPlacement placement(shape, gap, 3);
  placement.confine(block, lo, length);
  placement.repeat(period);
  const Vec3 point(1.5, 3.4, 1.5);
  placement.avoid_point(point);

  const rbc::RigidShape rigid(shape, 1);
  std::vector<Vertices> found;
  int across = 0;
  for (int n = 0; n < 4; ++n) {
    const auto place = placement.find(20000);
    ASSERT_TRUE(place);
    Vertices x = vertices_at(shape, *place);
    const rbc::RigidCell cell{&rigid, place->centre, place->rotation, 1};
    for (const int image : {-1, 0, 1}) EXPECT_GE(surface_gap(point + image * period, cell, 1), gap);
    for (const Vec3 &vertex : x)
      if (vertex[1] < 0 || vertex[1] > length[1]) {
        ++across;
        break;
      }
    for (const Vertices &other : found)
      for (const int image : {-1, 0, 1}) {
        Vertices there = other;
        for (Vec3 &vertex : there) vertex += image * period;
        EXPECT_GE(least_distance(shape, x, there), gap);
      }
    found.push_back(std::move(x));
  }
  EXPECT_GT(across, 1);
}

TEST(CellPlacement, SurfacesOfARowDoNotCountForEachOther)
{
  const SurfaceTemplate shape = disc(2).surface();
  CellPlacement placement(shape, 0.1, 1);
  placement.avoid_surface({shape.vertices, &shape.triangles}, 0.25);
  EXPECT_TRUE(placement.fits(shape.vertices, 0.1, 0.25));
  EXPECT_FALSE(placement.fits(shape.vertices, 0.1, 0.5));
  EXPECT_FALSE(placement.fits(shape.vertices, 0.1));
  placement.avoid_surface({shape.vertices, &shape.triangles});
  EXPECT_FALSE(placement.fits(shape.vertices, 0.1, 0.25));
}

TEST(CellPlacement, NeitherInsideASurfaceNorAroundOne)
{
  Mesh large = icosphere(3), small = icosphere(2);
  for (Vec3 &x : large.vertices) x *= 4;
  for (Vec3 &x : small.vertices) x *= 0.2;
  const SurfaceTemplate outer = large.surface(), cell = icosphere(3).surface(),
                        inner = small.surface();
  const Vec3 lo(-1.5, -1.5, -1.5), length(3, 3, 3);
  const Block block(lo, length);
  for (const SurfaceTemplate *there :
       {static_cast<const SurfaceTemplate *>(nullptr), &outer, &inner}) {
    CellPlacement placement(cell, 0.01, 2);
    placement.confine(block, lo, length);
    if (there) placement.avoid_surface({there->vertices, &there->triangles});
    EXPECT_EQ(bool(placement.find(200)), !there);
  }
}

TEST(CellPlacement, ADrawIsTheSameWhateverWasDrawnBefore)
{
  const SurfaceTemplate shape = disc(2).surface();
  const Vec3 lo(0, 0, 0), length(6, 6, 6);
  const Block block(lo, length);
  CellPlacement one(shape, 0.05, 9), other(shape, 0.05, 9), seeded(shape, 0.05, 10);
  for (CellPlacement *placement : {&one, &other, &seeded}) placement->confine(block, lo, length);
  while (one.drawn() < 40) one.find(1);
  one.clear();
  for (CellPlacement *placement : {&other, &seeded}) placement->set_drawn(one.drawn());
  const auto place = one.find(1000);
  const auto same = other.find(1000), differs = seeded.find(1000);
  ASSERT_TRUE(place && same && differs);
  EXPECT_EQ(place->centre, same->centre);
  EXPECT_EQ(place->rotation, same->rotation);
  EXPECT_EQ(one.drawn(), other.drawn());
  EXPECT_GT((place->centre - differs->centre).norm(), 0.01);
}

/// Means over n draws lie within 5 standard deviations of those of uniform distributions.
TEST(CellPlacement, PlacesAndDirectionsAreUniform)
{
  Mesh grain = icosphere(1);
  for (Vec3 &x : grain.vertices) x *= 1e-3;
  const SurfaceTemplate shape = grain.surface();
  const Vec3 lo(-1, 2, 5), length(2, 1, 4);
  const Block block(lo, length);
  CellPlacement placement(shape, 1e-4, 4);
  placement.confine(block, lo, length);
  const int count = 4000;
  Vec3 place = Vec3::Zero();
  Matrix3 mean = Matrix3::Zero(), squares = Matrix3::Zero();
  for (int n = 0; n < count; ++n) {
    placement.clear();
    const auto found = placement.find(1000);
    ASSERT_TRUE(found);
    const Matrix3 &turn = found->rotation;
    EXPECT_NEAR((turn.transpose() * turn - Matrix3::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(turn.determinant(), 1, 1e-12);
    place += (found->centre - lo).cwiseQuotient(length) / count;
    mean += turn / count;
    squares += turn.cwiseAbs2() / count;
  }
  const double root = std::sqrt(count);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(place[d], 0.5, 5 * std::sqrt(1.0 / 12) / root);
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5 * std::sqrt(1.0 / 3) / root);
  EXPECT_LT((squares - Matrix3::Constant(1.0 / 3)).cwiseAbs().maxCoeff(),
            5 * std::sqrt(4.0 / 45) / root);
}

}    // namespace
