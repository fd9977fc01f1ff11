// Ghost layers: what fill puts into them, that accumulate is its transpose, and messages sent.

#include "fluid/halo.h"
#include "test_support.h"

using namespace test;

namespace {

constexpr int width = 4;

std::vector<Grid> grids()
{
  std::vector<Grid> grids;
  for (const Index3 &cells : {Index3{13, 11, 9}, Index3{2, 3, 5}, Index3{1, 8, 2}, Index3{9, 2, 8}})
    for (bool walls : {false, true}) grids.push_back({cells, {0, 0, 0}, {1, 1, 1}, walls});
  return grids;
}

int wrap(int i, int n)
{
  return ((i % n) + n) % n;
}

bool beyond_plate(const Grid &grid, int k)
{
  return grid.plates && (k < 0 || k >= grid.cells[2]);
}

/// Rank that owns the cell of which (i, j, k) is an image.
int owner(const Grid &grid, const Decomposition &decomposition, int i, int j, int k)
{
  const Index3 cell{wrap(i, grid.cells[0]), wrap(j, grid.cells[1]), wrap(k, grid.cells[2])};
  for (int r = 0; r < decomposition.ranks(); ++r)
    if (decomposition.bricks[r].contains(cell)) return r;
  return -1;
}

template <typename Check> void for_each_case(Check check)
{
  for (const Grid &grid : grids())
    for (const auto &[name, decomposition] : layouts(grid)) {
      SCOPED_TRACE(describe(grid) + ", " + name);
      Halo halo(grid, decomposition, width);
      check(grid, decomposition, halo);
    }
}

TEST(Halo, StoresTheBrickAndItsGhosts)
{
  for_each_case([](const Grid &grid, const Decomposition &decomposition, const Halo &halo) {
    const Box &brick = decomposition.mine();
    for (int d = 0; d < 3; ++d) {
      const bool closed = d == 2 && grid.plates;
      const int lowest = brick.lo[d] - width, highest = brick.hi[d] + width;
      if (closed) {
        EXPECT_GE(halo.box().lo[d], lowest);
        EXPECT_LE(halo.box().hi[d], highest);
        EXPECT_LE(halo.box().lo[d], std::max(lowest, -Halo::plate_layers));
        EXPECT_GE(halo.box().hi[d], std::min(highest, grid.cells[d] + Halo::plate_layers));
      } else {
        EXPECT_EQ(halo.box().lo[d], lowest);
        EXPECT_EQ(halo.box().hi[d], highest);
      }
    }
  });
}

TEST(Halo, FillGivesEveryGhostTheValueOfItsOwner)
{
  for_each_case([](const Grid &grid, const Decomposition &decomposition, Halo &halo) {
    VectorField field(halo.box());
    for (int c = 0; c < 3; ++c) {
      set(field[c], halo.box(), [](int, int, int) { return undefined; });
      set(field[c], decomposition.mine(), [&](int i, int j, int k) { return noise(c, i, j, k); });
    }
    halo.fill(field.views());
    int wrong = 0;
    for (int c = 0; c < 3; ++c)
      for_each(halo.box(), [&](int i, int j, int k) {
        const double value = field[c](i, j, k);
        const double expected = noise(c, wrap(i, grid.cells[0]), wrap(j, grid.cells[1]),
                                      grid.plates ? k : wrap(k, grid.cells[2]));
        wrong += beyond_plate(grid, k) ? !std::isnan(value) : value != expected;
      });
    EXPECT_EQ(wrong, 0);
  });
}

TEST(Halo, AddBackIsTheTransposeOfFill)
{
  for_each_case([](const Grid &, const Decomposition &decomposition, Halo &halo) {
    const Box &brick = decomposition.mine();
    VectorField a = noise_field(halo.box(), brick, 1);
    VectorField filled = noise_field(halo.box(), brick, 1);
    VectorField b(halo.box()), summed(halo.box());
    for (int c = 0; c < 3; ++c) {
      // ghosts of different ranks are independent numbers
      const auto value = [&](int i, int j, int k) { return noise(7 + c + 3 * rank(), i, j, k); };
      set(b[c], halo.box(), value);
      set(summed[c], halo.box(), value);
    }
    halo.fill(filled.views());
    halo.accumulate(summed.views());
    double left = dot(filled, b, halo.box()), right = dot(a, summed, brick);
    double square_a = dot(filled, filled, halo.box()), square_b = dot(b, b, halo.box());
    reduce(MPI_SUM, left, right, square_a, square_b);
    EXPECT_NEAR(left, right, 1e-13 * std::sqrt(square_a * square_b));
  });
}

TEST(Halo, SendsOneMessageToEachRankThatMirrorsItsCells)
{
  for_each_case([](const Grid &grid, const Decomposition &decomposition, Halo &halo) {
    std::vector<int> mirrored(ranks(), 0), mirrors(ranks());
    for_each(halo.box(), [&](int i, int j, int k) {
      if (!beyond_plate(grid, k)) mirrored[owner(grid, decomposition, i, j, k)] = 1;
    });
    MPI_Alltoall(mirrored.data(), 1, MPI_INT, mirrors.data(), 1, MPI_INT, MPI_COMM_WORLD);
    int owners = 0, readers = 0;
    for (int r = 0; r < ranks(); ++r)
      if (r != rank()) {
        owners += mirrored[r];
        readers += mirrors[r];
      }

    VectorField field(halo.box());
    halo.fill(field.views());
    EXPECT_EQ(halo.traffic().messages, readers);
    halo.accumulate(field.views());
    EXPECT_EQ(halo.traffic().messages, readers + owners);
    EXPECT_EQ(halo.traffic().bytes > 0, readers + owners > 0);
  });
}

}    // namespace
