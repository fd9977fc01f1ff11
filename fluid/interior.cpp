#include "fluid/interior.h"

namespace fluid {

namespace {

constexpr int samples = 4;    // of a cell, in each direction

}    // namespace

Interior::Interior(const Grid &grid, const Decomposition &decomposition,
                   const std::function<bool(const Real3 &)> &contains)
{
  const Box &brick = decomposition.mine();
  Box nodes = brick;
  if (!brick.empty())
    for (int d = 0; d < 3; ++d) ++nodes.hi[d];
  const auto inside = [&](double i, double j, double k) {
    return contains({grid.origin[0] + i * grid.spacing[0], grid.origin[1] + j * grid.spacing[1],
                     grid.origin[2] + k * grid.spacing[2]});
  };
  std::vector<char> at_node;
  at_node.reserve(nodes.size());
  for_each_cell(nodes, [&](int i, int j, int k) { at_node.push_back(inside(i, j, k)); });

  share_.reserve(brick.size());
  double sum = 0;
  for_each_cell(brick, [&](int i, int j, int k) {
    int corners = 0, count = 0;
    for (int c = 0; c < 8; ++c)
      corners += at_node[nodes.offset(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))];
    if (corners == 0 || corners == 8)
      count = corners > 0 ? samples * samples * samples : 0;
    else
      for (int n = 0; n < samples * samples * samples; ++n)
        count +=
            inside(i + (n % samples + 0.5) / samples, j + (n / samples % samples + 0.5) / samples,
                   k + (n / samples / samples + 0.5) / samples);
    share_.push_back(static_cast<float>(count) / (samples * samples * samples));
    sum += share_.back();
  });
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, decomposition.comm);
  volume_ = sum * grid.cell_volume();
}

void Interior::add_force(const Flow &flow, const Real3 &density) const
{
  const auto f = flow.force().views();
  std::size_t cell = 0;
  for_each_cell(flow.brick(), [&](int i, int j, int k) {
    const double half = 0.5 * share_[cell++];
    for (int c = 0; c < 3; ++c) {
      f[c](i, j, k) += half * density[c];
      f[c](i + (c == 0), j + (c == 1), k + (c == 2)) += half * density[c];
    }
  });
}

Real3 Interior::mean_velocity(Flow &flow) const
{
  flow.fill_ghosts();
  const auto u = flow.velocity().views();
  Real3 mean{0, 0, 0};
  std::size_t cell = 0;
  for_each_cell(flow.brick(), [&](int i, int j, int k) {
    const double weight = 0.5 * share_[cell++];
    mean[0] += weight * (u[0](i, j, k) + u[0](i + 1, j, k));
    mean[1] += weight * (u[1](i, j, k) + u[1](i, j + 1, k));
    mean[2] += weight * (u[2](i, j, k) + u[2](i, j, k + 1));
  });
  MPI_Allreduce(MPI_IN_PLACE, mean.data(), 3, MPI_DOUBLE, MPI_SUM, flow.decomposition().comm);
  for (double &component : mean) component *= flow.grid().cell_volume() / volume_;
  return mean;
}

}    // namespace fluid
