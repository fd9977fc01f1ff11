#include "fluid/smooth_source.h"

#include "fluid/torsion.h"

#include <algorithm>
#include <numeric>

namespace fluid {

namespace {

struct Share {
  std::int64_t cell;
  double weight;
};

double sum(const std::vector<Share> &shares)
{
  return std::accumulate(shares.begin(), shares.end(), 0.0,
                         [](double sum, const Share &share) { return sum + share.weight; });
}

/// Gives half of `variance` to the neighbours on both sides in direction d.
std::vector<Share> spread_along(const Grid &grid, int d, double variance,
                                const std::vector<Share> &shares)
{
  const auto &n = grid.cells;
  const std::int64_t stride = d == 0 ? 1 : d == 1 ? n[0] : std::int64_t(n[0]) * n[1];
  std::vector<Share> all;
  for (const auto &[cell, weight] : shares) {
    const int here = static_cast<int>(cell / stride % n[d]);
    for (int side : {-1, 0, 1}) {
      int there = here + side;
      if (d == 2 && grid.plates) there = std::clamp(there, 0, n[d] - 1);
      there = (there + n[d]) % n[d];
      const double part = side == 0 ? 1 - variance : variance / 2;
      all.push_back({cell + (there - here) * stride, part * weight});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Share &a, const Share &b) { return a.cell < b.cell; });
  std::vector<Share> merged;
  for (const Share &share : all)
    if (!merged.empty() && merged.back().cell == share.cell)
      merged.back().weight += share.weight;
    else
      merged.push_back(share);
  return merged;
}

/// What all ranks have, in ascending order. Collective.
std::vector<std::int64_t> gathered(const std::vector<std::int64_t> &mine, MPI_Comm comm)
{
  int ranks;
  MPI_Comm_size(comm, &ranks);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  std::vector<std::int64_t> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, MPI_INT64_T, all.data(), counts.data(), starts.data(),
                 MPI_INT64_T, comm);
  std::sort(all.begin(), all.end());
  return all;
}

}    // namespace

SmoothSource::SmoothSource(const Grid &grid, const Decomposition &decomposition,
                           const std::function<bool(const Real3 &)> &contains, double variance) :
    cell_volume_(grid.cell_volume())
{
  const Box domain = grid.domain();
  std::vector<std::int64_t> mine;
  for_each_cell(decomposition.mine(), [&](int i, int j, int k) {
    const Real3 index{i + 0.5, j + 0.5, k + 0.5};
    Real3 centre;
    for (int d = 0; d < 3; ++d) centre[d] = grid.origin[d] + index[d] * grid.spacing[d];
    if (contains(centre)) mine.push_back(domain.offset(i, j, k));
  });
  const std::vector<std::int64_t> all = gathered(mine, decomposition.comm);
  volume_ = cell_volume_ * static_cast<double>(all.size());
  whole_grid_ = all.size() == grid.size();
  if (whole_grid_) return;
  const std::vector<double> shape = torsion_function(grid, all);
  const auto place = [n = grid.cells](std::int64_t cell) {
    return Index3{int(cell % n[0]), int(cell / n[0] % n[1]), int(cell / n[0] / n[1])};
  };
  const auto is_mine = [&](std::int64_t cell) {
    return decomposition.mine().contains(place(cell));
  };

  std::vector<Share> shares, core;
  const double half = all.empty() ? 0 : *std::max_element(shape.begin(), shape.end()) / 2;
  for (std::size_t m = 0; m < all.size(); ++m) {
    shares.push_back({all[m], shape[m]});
    if (shape[m] > half) core.push_back({all[m], shape[m]});
  }
  for (int d = 0; d < 3 && variance > 0; ++d) shares = spread_along(grid, d, variance, shares);
  const double total = cell_volume_ * sum(shares), core_total = sum(core);
  for (const auto &[cell, weight] : shares)
    if (is_mine(cell)) mine_.push_back({place(cell), weight / total});
  for (const auto &[cell, weight] : core)
    if (is_mine(cell)) core_.push_back({place(cell), weight / core_total});
}

void SmoothSource::add(double rate, const ScalarField &supply) const
{
  for (const Cell &cell : mine_)
    supply[0](cell.place[0], cell.place[1], cell.place[2]) += rate * cell.weight;
}

double SmoothSource::core_mean(const ScalarField &values, MPI_Comm comm) const
{
  double sum = 0;
  for (const Cell &cell : core_)
    sum += cell.weight * values[0](cell.place[0], cell.place[1], cell.place[2]);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return sum;
}

}    // namespace fluid
