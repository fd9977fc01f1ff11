#pragma once

#include "fluid/spreading.h"
#include "forced_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace test {

using namespace fluid;

constexpr double pi = 3.14159265358979323846;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// ---- ranks

inline int rank()
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int ranks()
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

template <typename... Values> void reduce(MPI_Op op, Values &...values)
{
  std::array<double, sizeof...(Values)> all{values...};
  MPI_Allreduce(MPI_IN_PLACE, all.data(), sizeof...(Values), MPI_DOUBLE, op, MPI_COMM_WORLD);
  const double *next = all.data();
  ((values = *next++), ...);
}

inline double sum(double value)
{
  reduce(MPI_SUM, value);
  return value;
}

inline double max(double value)
{
  reduce(MPI_MAX, value);
  return value;
}

// ---- decompositions

/// Bricks between the cuts of each direction, x fastest; ranks beyond the last brick own nothing.
inline Decomposition decompose(const std::array<std::vector<int>, 3> &cuts)
{
  Index3 parts, at;
  for (int d = 0; d < 3; ++d) parts[d] = static_cast<int>(cuts[d].size()) - 1;
  Box mine;
  if (rank() < parts[0] * parts[1] * parts[2]) {
    at = {rank() % parts[0], rank() / parts[0] % parts[1], rank() / parts[0] / parts[1]};
    for (int d = 0; d < 3; ++d) {
      mine.lo[d] = cuts[d][at[d]];
      mine.hi[d] = cuts[d][at[d] + 1];
    }
  }
  return {MPI_COMM_WORLD, mine};
}

inline std::vector<int> even_cuts(int n, int parts)
{
  std::vector<int> cuts;
  for (int part = 0; part <= parts; ++part) cuts.push_back(n * part / parts);
  return cuts;
}

/// All bricks one cell wide but the last.
inline std::vector<int> thin_cuts(int n, int parts)
{
  std::vector<int> cuts = even_cuts(n, parts);
  for (int part = 0; part < parts; ++part) cuts[part] = part;
  return cuts;
}

inline Decomposition even(const Grid &grid, const Index3 &parts)
{
  std::array<std::vector<int>, 3> cuts;
  for (int d = 0; d < 3; ++d) cuts[d] = even_cuts(grid.cells[d], parts[d]);
  return decompose(cuts);
}

/// The whole grid on this rank, whatever the others do.
inline Decomposition alone(const Grid &grid)
{
  return {MPI_COMM_SELF, grid.domain()};
}

struct Layout {
  std::string name;
  Decomposition decomposition;
};

/// Slabs, pencils and bricks for the ranks at hand, of even and of very uneven width, and with a
/// rank that owns nothing.
inline std::vector<Layout> layouts(const Grid &grid)
{
  std::vector<Layout> layouts;
  for (int used : {ranks(), ranks() - 1})
    for (int x = 1; x <= used; ++x)
      for (int y = 1; x * y <= used; ++y) {
        const Index3 parts{x, y, used / (x * y)};
        if (x * y * parts[2] != used) continue;
        bool fits = true;
        for (int d = 0; d < 3; ++d) fits = fits && parts[d] <= grid.cells[d];
        if (!fits) continue;
        for (bool thin : {false, true}) {
          if (thin && used == 1) continue;
          std::array<std::vector<int>, 3> cuts;
          for (int d = 0; d < 3; ++d)
            cuts[d] = (thin ? thin_cuts : even_cuts)(grid.cells[d], parts[d]);
          layouts.push_back({std::to_string(x) + 'x' + std::to_string(y) + 'x' +
                                 std::to_string(parts[2]) + (thin ? " thin" : " even"),
                             decompose(cuts)});
        }
      }
  return layouts;
}

inline std::string describe(const Grid &grid)
{
  std::string text;
  for (int n : grid.cells) text += std::to_string(n) + ' ';
  if (!grid.plates) return text + "cells, periodic";
  const auto name = [](PlateCondition condition) {
    return condition == PlateCondition::no_slip ? " no-slip" : " free-slip";
  };
  return text + "cells, plates" + name(grid.plate_conditions.lower) +
         name(grid.plate_conditions.upper);
}

// ---- values

/// Uniform in [-1, 1), a pure function of the arguments: the same on every rank and in every
/// layout.
inline double noise(int a, int b = 0, int c = 0, int d = 0)
{
  std::uint64_t bits = 0;
  for (int n : {a, b, c, d}) {
    bits = (bits ^ static_cast<std::uint64_t>(n)) + 0x9e3779b97f4a7c15;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
    bits ^= bits >> 31;
  }
  return std::ldexp(static_cast<double>(bits >> 11), -52) - 1;
}

/// Where component c of a vector stands: the middle of the lower face of cell (i, j, k); c = 3: its
/// centre.
inline Real3 location(const Grid &grid, int c, int i, int j, int k)
{
  const Index3 index{i, j, k};
  Real3 x;
  for (int d = 0; d < 3; ++d)
    x[d] = grid.origin[d] + grid.spacing[d] * (index[d] + (d == c ? 0.0 : 0.5));
  return x;
}

constexpr int centre = 3;

template <typename Visit> void for_each(const Box &box, Visit visit)
{
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i) visit(i, j, k);
}

/// Sets value(i, j, k) over a box.
template <typename T, typename Value>
void set(const View<T> &view, const Box &box, const Value &value)
{
  for_each(box, [&](int i, int j, int k) { view(i, j, k) = value(i, j, k); });
}

/// Sets component c of a vector field to value(c, x) at its points in a box.
template <typename Value>
void set_vector(const VectorField &field, const Grid &grid, const Box &box, const Value &value)
{
  for (int c = 0; c < 3; ++c)
    set(field[c], box, [&](int i, int j, int k) { return value(c, location(grid, c, i, j, k)); });
}

/// Noise on the brick, zero in the ghost cells.
inline VectorField noise_field(const Box &stored, const Box &brick, int seed)
{
  VectorField field(stored);
  for (int c = 0; c < 3; ++c)
    set(field[c], brick, [&](int i, int j, int k) { return noise(4 * seed + c, i, j, k); });
  return field;
}

/// Local sum over a box of the product of two fields.
inline double dot(const VectorField &a, const VectorField &b, const Box &box)
{
  double sum = 0;
  for (int c = 0; c < 3; ++c)
    for_each(box, [&](int i, int j, int k) { sum += a[c](i, j, k) * b[c](i, j, k); });
  return sum;
}

/// Largest error and root of the mean square error over all ranks.
struct Error {
  double largest = 0, square = 0, count = 0;

  void add(double difference)
  {
    largest = std::max(largest, std::isnan(difference) ? HUGE_VAL : std::abs(difference));
    square += difference * difference;
    ++count;
  }
  Error over_ranks() const
  {
    Error all = *this;
    reduce(MPI_MAX, all.largest);
    reduce(MPI_SUM, all.square, all.count);
    return all;
  }
  double rms() const { return std::sqrt(square / count); }
};

// ---- markers

inline const double *numbers(const std::vector<Real3> &rows)
{
  return rows.empty() ? nullptr : rows[0].data();
}
inline double *numbers(std::vector<Real3> &rows)
{
  return rows.empty() ? nullptr : rows[0].data();
}

/// Markers known to every rank; `index` lists those of this rank.
struct Points {
  std::vector<Real3> position, force;
  std::vector<int> index;

  int count() const { return static_cast<int>(position.size()); }
  MarkerSet markers(KernelKind kernel, MarkerKind kind = MarkerKind::points) const
  {
    return {kernel, kind, static_cast<int>(index.size()), index.data(), x()};
  }
  const double *x() const { return numbers(position); }
  const double *f() const { return numbers(force); }
};

/// Gives each marker to the rank in whose brick it lies; those on the upper plate count as below
/// it.
inline void assign(Points &points, const Grid &grid, const Decomposition &decomposition)
{
  points.index.clear();
  for (int n = 0; n < points.count(); ++n) {
    Index3 cell;
    for (int d = 0; d < 3; ++d) {
      const double s = (points.position[n][d] - grid.origin[d]) / grid.spacing[d];
      cell[d] = std::min(std::max(0, static_cast<int>(std::floor(s))), grid.cells[d] - 1);
    }
    if (decomposition.mine().contains(cell)) points.index.push_back(n);
  }
}

/// Random forces at random places, of which, between plates, every eighth lies on either plate and
/// every fourth within a cell of one.
inline Points scatter(const Grid &grid, int count, int seed)
{
  Points points;
  for (int n = 0; n < count; ++n) {
    Real3 s;
    for (int d = 0; d < 3; ++d) s[d] = 0.5 * (1 + noise(seed, n, d)) * grid.cells[d];
    if (grid.plates && n % 8 == 0) s[2] = 0;
    if (grid.plates && n % 8 == 1) s[2] = grid.cells[2];
    if (grid.plates && n % 8 == 2) s[2] = s[2] / grid.cells[2];
    if (grid.plates && n % 8 == 3) s[2] = grid.cells[2] - s[2] / grid.cells[2];
    for (int d = 0; d < 3; ++d) s[d] = grid.origin[d] + grid.spacing[d] * s[d];
    points.position.push_back(s);
    points.force.push_back({noise(seed, n, 3), noise(seed, n, 4), noise(seed, n, 5)});
  }
  return points;
}

/// Moves each marker by up to one cell in every direction, not through a plate.
inline void drift(Points &points, const Grid &grid, int seed)
{
  for (int n = 0; n < points.count(); ++n)
    for (int d = 0; d < 3; ++d) {
      if (d == 2 && grid.plates && n % 8 < 4) continue;
      double &x = points.position[n][d];
      x += grid.spacing[d] * noise(seed, n, d);
      const double lowest = grid.origin[d], highest = lowest + grid.spacing[d] * grid.cells[d];
      if (d == 2 && grid.plates) x = std::min(std::max(x, lowest), highest);
    }
}

inline double order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

}    // namespace test
