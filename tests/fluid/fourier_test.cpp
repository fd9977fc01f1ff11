// Distributed real transform in x and y: against sums written out, round trip, and messages sent.

#include "fluid/fourier.h"
#include "test_support.h"

using namespace test;

namespace {

constexpr int ghosts = 3;

Box with_ghosts(const Box &brick)
{
  Box box = brick;
  if (!brick.empty())
    for (int d = 0; d < 3; ++d) {
      box.lo[d] -= ghosts;
      box.hi[d] += ghosts;
    }
  return box;
}

/// Noise on the brick between ghosts that must be neither read nor written.
VectorField guarded_noise(const Box &brick)
{
  VectorField field(with_ghosts(brick));
  for (int c = 0; c < 3; ++c) {
    set(field[c], field.box(), [](int, int, int) { return undefined; });
    set(field[c], brick, [&](int i, int j, int k) { return noise(c, i, j, k); });
  }
  return field;
}

Grid grid_of(const Index3 &cells)
{
  return {cells, {0, 0, 0}, {1, 1, 1}};
}

const std::vector<Index3> sizes{{8, 6, 5},   {9, 8, 4},  {16, 15, 7},
                                {13, 11, 8}, {12, 7, 9}, {4, 31, 8}};

/// Modes of all ranks cover each (kx, ky, z) once.
void expect_cover(const Grid &grid, const Box &modes)
{
  EXPECT_EQ(sum(modes.size()), (grid.cells[0] / 2 + 1.0) * grid.cells[1] * grid.cells[2]);
  EXPECT_TRUE(modes.empty() || modes.extent(2) == grid.cells[2]);
}

TEST(Fourier, ForwardIsTheSumOverThePlane)
{
  const Grid grid = grid_of({10, 7, 4});
  const auto [nx, ny, nz] = grid.cells;
  for (const auto &[name, decomposition] : layouts(grid)) {
    SCOPED_TRACE(name);
    const VectorField field = guarded_noise(decomposition.mine());
    Fourier fourier(grid, decomposition);
    expect_cover(grid, fourier.modes());
    fourier.forward(field.views());
    double error = 0;
    for (int c = 0; c < 3; ++c)
      for_each(fourier.modes(), [&, nx = nx, ny = ny](int kx, int ky, int z) {
        Complex sum = 0;
        for (int j = 0; j < ny; ++j)
          for (int i = 0; i < nx; ++i)
            sum += noise(c, i, j, z) *
                   std::polar(1.0, -2 * pi * (double(kx) * i / nx + double(ky) * j / ny));
        error = std::max(error, std::abs(fourier.spectrum(c)(kx, ky, z) - sum));
      });
    EXPECT_LT(max(error), 1e-13 * nx * ny);
  }
}

TEST(Fourier, ForwardAndBackwardGiveTheNumberOfPoints)
{
  for (const Index3 &cells : sizes)
    for (const auto &[name, decomposition] : layouts(grid_of(cells))) {
      SCOPED_TRACE(describe(grid_of(cells)) + ", " + name);
      const Box &brick = decomposition.mine();
      const VectorField field = guarded_noise(brick);
      VectorField result(field.box());
      for (int c = 0; c < 3; ++c)
        set(result[c], field.box(), [](int, int, int) { return undefined; });
      Fourier fourier(grid_of(cells), decomposition);
      expect_cover(grid_of(cells), fourier.modes());
      fourier.forward(field.views());
      fourier.backward(result.views());

      const int points = cells[0] * cells[1];
      Error error, input;
      int touched = 0;
      for (int c = 0; c < 3; ++c)
        for_each(field.box(), [&](int i, int j, int k) {
          if (brick.contains({i, j, k})) {
            error.add(result[c](i, j, k) / points - noise(c, i, j, k));
            input.add(field[c](i, j, k) - noise(c, i, j, k));
          } else {
            touched += !std::isnan(result[c](i, j, k));
          }
        });
      EXPECT_LT(error.over_ranks().largest, 1e-13);
      EXPECT_EQ(input.over_ranks().largest, 0) << "the values transformed must survive";
      EXPECT_EQ(touched, 0) << "ghosts written";
    }
}

TEST(Fourier, APlaneWaveIsOneMode)
{
  const Grid grid = grid_of({12, 9, 6});
  const auto [nx, ny, nz] = grid.cells;
  const int mx = 3, my = 7;    // that is, -2
  const double phase = 0.4;
  for (const auto &[name, decomposition] : layouts(grid)) {
    SCOPED_TRACE(name);
    const Box &brick = decomposition.mine();
    VectorField field(brick);
    for (int c = 0; c < 3; ++c)
      set(field[c], brick, [&, nx = nx, ny = ny](int i, int j, int k) {
        return (c + 1) * k * std::cos(2 * pi * (double(mx) * i / nx + double(my) * j / ny) + phase);
      });
    Fourier fourier(grid, decomposition);
    fourier.forward(field.views());
    double error = 0;
    for (int c = 0; c < 3; ++c)
      for_each(fourier.modes(), [&, nx = nx, ny = ny](int kx, int ky, int z) {
        const Complex expected =
            kx == mx && ky == my ? std::polar(0.5 * nx * ny * (c + 1) * z, phase) : 0;
        error = std::max(error, std::abs(fourier.spectrum(c)(kx, ky, z) - expected));
      });
    EXPECT_LT(max(error), 1e-13 * nx * ny * 3 * nz);
  }
}

/// Messages that this rank sends for one forward and one backward transform.
std::array<long, 2> messages(const Grid &grid, const Index3 &parts)
{
  const Decomposition decomposition = even(grid, parts);
  const VectorField field = guarded_noise(decomposition.mine());
  Fourier fourier(grid, decomposition);
  fourier.forward(field.views());
  const long forward = fourier.traffic().messages;
  fourier.backward(field.views());
  return {forward, fourier.traffic().messages - forward};
}

TEST(Fourier, SlabsAcrossZNeedOneTransposition)
{
  const std::array<long, 2> expected{ranks() - 1, ranks() - 1};
  EXPECT_EQ(messages(grid_of({32, 16, 16}), {1, 1, ranks()}), expected);
}

TEST(Fourier, SlabsAcrossYNeedOneTransposition)
{
  const std::array<long, 2> expected{ranks() - 1, ranks() - 1};
  EXPECT_EQ(messages(grid_of({32, 16, 16}), {1, ranks(), 1}), expected);
}

TEST(Fourier, PencilsAlongXNeedTwoTranspositionsWithinRowsAndColumns)
{
  for (int a = 2; a < ranks(); ++a) {
    if (ranks() % a != 0) continue;
    const int b = ranks() / a;
    const std::array<long, 2> expected{a - 1 + b - 1, a - 1 + b - 1};
    EXPECT_EQ(messages(grid_of({32, 16, 16}), {1, a, b}), expected);
  }
}

}    // namespace
