#include "fluid/pencils.h"

#include <limits>

namespace fluid {

namespace {

/// Ranks in an a-by-b arrangement; rank r stands in row `first(r)` and column `second(r)`.
struct RankTable {
  int a, b;
  bool second_fastest;

  int first(int r) const { return second_fastest ? r / b : r % a; }
  int second(int r) const { return second_fastest ? r % b : r / a; }
};

/// First of n cells whose centre lies beyond the given share, as LAMMPS divides a grid among
/// subdomains.
int share(int n, int parts, int part)
{
  return static_cast<int>((2L * n * part + parts - 1) / (2L * parts));
}

void split(Box &box, int d, int n, int parts, int part)
{
  box.lo[d] = share(n, parts, part);
  box.hi[d] = share(n, parts, part + 1);
}

Pencils arrange(const Grid &grid, const RankTable &table)
{
  const auto [nx, ny, nz] = grid.cells;
  const int modes = nx / 2 + 1;
  const int ranks = table.a * table.b;
  Pencils pencils;
  for (int r = 0; r < ranks; ++r) {
    const int first = table.first(r), second = table.second(r);
    Box real_x{{0, 0, 0}, {nx, ny, nz}};
    split(real_x, 1, ny, table.a, first);
    split(real_x, 2, nz, table.b, second);
    Box x = real_x;
    x.hi[0] = modes;
    Box y{{0, 0, 0}, {modes, ny, nz}};
    split(y, 0, modes, table.a, first);
    split(y, 2, nz, table.b, second);
    Box z{{0, 0, 0}, {modes, ny, nz}};
    split(z, 0, modes, table.a, first);
    split(z, 1, ny, table.b, second);
    pencils.real_x.push_back(real_x);
    pencils.x.push_back(x);
    pencils.y.push_back(y);
    pencils.z.push_back(z);
  }
  return pencils;
}

double values_moved(const std::vector<Box> &from, const std::vector<Box> &to)
{
  double moved = 0;
  for (std::size_t r = 0; r < from.size(); ++r)
    moved += from[r].size() - intersection(from[r], to[r]).size();
  return moved;
}

/// A complex mode counts as two values; the busiest rank sets the time of the transforms.
double cost(const std::vector<Box> &bricks, const Pencils &pencils)
{
  double busiest = 0;
  for (const Box &box : pencils.y) busiest = std::max(busiest, double(box.size()));
  return values_moved(bricks, pencils.real_x) + 2 * values_moved(pencils.x, pencils.y) +
         2 * values_moved(pencils.y, pencils.z) + busiest * bricks.size();
}

}    // namespace

Pencils choose_pencils(const Grid &grid, const std::vector<Box> &bricks)
{
  const int ranks = static_cast<int>(bricks.size());
  Pencils best;
  double least = std::numeric_limits<double>::max();
  for (int a = 1; a <= ranks; ++a) {
    if (ranks % a != 0) continue;
    for (bool second_fastest : {true, false}) {
      Pencils candidate = arrange(grid, {a, ranks / a, second_fastest});
      const double candidate_cost = cost(bricks, candidate);
      if (candidate_cost < least) {
        least = candidate_cost;
        best = std::move(candidate);
      }
    }
  }
  return best;
}

}    // namespace fluid
