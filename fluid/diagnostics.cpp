#include "fluid/diagnostics.h"

#include <cmath>

namespace fluid {

namespace {

template <typename Values> void sum_over_ranks(Values &values, MPI_Comm comm)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                comm);
}

/// The shear tractions are those of the discrete equations, so that plates and applied forces
/// balance to round-off; the normal ones are the mean pressure at the plates, of mean zero over the
/// fluid.
void find_tractions(const Flow &flow, const Forcing &forcing, FlowDiagnostics &measures)
{
  const Grid &grid = flow.grid();
  const auto u = flow.velocity().views();
  const bool advected = flow.equations().inertia == Inertia::convective;
  const int n = grid.cells[2];
  std::vector<double> sums(11 + n);    // u, v at each plate; forces into plates; w^2; f_w of planes
  for_each_cell(flow.brick(), [&](int i, int j, int k) {
    for (int c = 0; c < 2; ++c) {
      if (k == 0) sums[c] += u[c](i, j, k);
      if (k == n - 1) sums[2 + c] += u[c](i, j, k);
    }
    const double w = 0.5 * (u[2](i, j, k) + u[2](i, j, k + 1));
    if (advected) sums[10] += w * w;
    if (flow.has_force()) sums[11 + k] += flow.force()[2](i, j, k);
  });
  for (int c = 0; c < 3; ++c) {
    sums[4 + c] = flow.lower_direct()[c];
    sums[7 + c] = flow.upper_direct()[c];
  }
  sum_over_ranks(sums, flow.decomposition().comm);

  const double per_plane = 1.0 / (double(grid.cells[0]) * grid.cells[1]), h = grid.spacing[2];
  double pressure = 0, mean = -flow.equations().density * sums[10] / grid.size();
  for (int k = 1; k < n; ++k) {
    pressure += h * (sums[11 + k] * per_plane + forcing.body[2]);
    mean += pressure / n;
  }
  for (int c = 0; c < 3; ++c) {
    measures.lower_traction[c] = sums[4 + c] * per_plane * h;
    measures.upper_traction[c] = sums[7 + c] * per_plane * h;
  }
  const ImageFactors images = grid.plate_conditions.factors();
  const double lower = (1 - images.lower) * flow.equations().viscosity / h;
  const double upper = (1 - images.upper) * flow.equations().viscosity / h;
  for (int c = 0; c < 2; ++c) {
    measures.lower_traction[c] += lower * (sums[c] * per_plane - forcing.plates.lower[c]);
    measures.upper_traction[c] += upper * (sums[2 + c] * per_plane - forcing.plates.upper[c]);
  }
  const double weight = h / 2 * forcing.body[2];    // of the half cells at the plates
  measures.lower_traction[2] += weight + mean;
  measures.upper_traction[2] += weight + pressure - mean;
}

}    // namespace

FlowDiagnostics diagnose(Flow &flow, const Forcing &forcing)
{
  const auto v = flow.fluid_velocity().views();
  const Grid &grid = flow.grid();
  const auto u = flow.velocity().views();
  const ScalarField *const source = flow.source();
  std::array<double, 4> sums{};
  std::array<double, 2> largest{};
  for_each_cell(flow.brick(), [&](int i, int j, int k) {
    const Real3 low{u[0](i, j, k), u[1](i, j, k), u[2](i, j, k)};
    const Real3 high{u[0](i + 1, j, k), u[1](i, j + 1, k), u[2](i, j, k + 1)};
    double speed2 = 0, divergence = source ? -(*source)[0](i, j, k) : 0;
    for (int c = 0; c < 3; ++c) {
      const double here = v[c](i, j, k), next = v[c](i + (c == 0), j + (c == 1), k + (c == 2));
      sums[c] += low[c];
      sums[3] += 0.25 * (here * here + next * next);
      speed2 += 0.25 * (here + next) * (here + next);
      divergence += (high[c] - low[c]) / grid.spacing[c];
    }
    largest[0] = std::max(largest[0], std::sqrt(speed2));
    largest[1] = std::max(largest[1], std::abs(divergence));
  });
  sum_over_ranks(sums, flow.decomposition().comm);
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, flow.decomposition().comm);

  FlowDiagnostics measures;
  for (int c = 0; c < 3; ++c) measures.mean_velocity[c] = sums[c] / grid.size();
  measures.kinetic_energy_per_density = sums[3] * grid.cell_volume();
  measures.max_speed = largest[0];
  const double h = *std::min_element(grid.spacing.begin(), grid.spacing.end());
  measures.max_divergence = largest[0] > 0 ? largest[1] * h / largest[0] : 0;
  if (grid.plates) find_tractions(flow, forcing, measures);
  return measures;
}

}    // namespace fluid
