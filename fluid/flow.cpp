#include "flow.h"

#include <cmath>

namespace fluid {

namespace {

template <typename Visit> void for_each_cell(const Box &box, Visit visit)
{
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i) visit(i, j, k);
}

template <typename Values> void sum_over_ranks(Values &values, MPI_Comm comm)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                comm);
}

}    // namespace

Flow::Flow(const Grid &grid, const Decomposition &decomposition, int ghost_layers,
           double viscosity) :
    grid_(grid),
    decomposition_(decomposition), viscosity_(viscosity), halo_(grid, decomposition, ghost_layers),
    force_(halo_.box()), velocity_(halo_.box()),
    solver_(grid, decomposition, halo_.box(), viscosity, 0.0, true)
{
}

void Flow::clear_force()
{
  force_.clear();
  lower_direct_ = upper_direct_ = {0, 0, 0};
}

int Flow::spread(KernelKind kernel, const Markers &markers, const double *position,
                 const double *force, double factor)
{
  return fluid::spread(kernel, grid_, markers, position, force, factor, force_);
}

void Flow::gather_force()
{
  if (grid_.walls) fold_force(grid_, force_, lower_direct_, upper_direct_);
  halo_.add_back(force_.views());
}

void Flow::solve()
{
  solver_.velocity(force_, drive, velocity_);
}

void Flow::share_velocity()
{
  halo_.fill(velocity_.views());
  if (grid_.walls) reflect_velocity(grid_, drive.walls, velocity_);
}

void Flow::interpolate(KernelKind kernel, const Markers &markers, const double *position,
                       double *velocity) const
{
  fluid::interpolate(kernel, grid_, markers, position, velocity_, velocity);
}

const ScalarField &Flow::pressure()
{
  if (!pressure_.bytes()) pressure_ = ScalarField(halo_.box());
  solver_.pressure(force_, drive, pressure_);
  return pressure_;
}

FlowMeasures Flow::measure() const
{
  const auto u = velocity_.views();
  std::array<double, 4> sums{};
  std::array<double, 2> largest{};
  for_each_cell(brick(), [&](int i, int j, int k) {
    const Vec3 low{u[0](i, j, k), u[1](i, j, k), u[2](i, j, k)};
    const Vec3 high{u[0](i + 1, j, k), u[1](i, j + 1, k), u[2](i, j, k + 1)};
    double speed2 = 0, divergence = 0;
    for (int c = 0; c < 3; ++c) {
      sums[c] += low[c];
      sums[3] += 0.25 * (low[c] * low[c] + high[c] * high[c]);
      speed2 += 0.25 * (low[c] + high[c]) * (low[c] + high[c]);
      divergence += (high[c] - low[c]) / grid_.spacing[c];
    }
    largest[0] = std::max(largest[0], std::sqrt(speed2));
    largest[1] = std::max(largest[1], std::abs(divergence));
  });
  sum_over_ranks(sums, decomposition_.comm);
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, decomposition_.comm);

  FlowMeasures measures;
  for (int c = 0; c < 3; ++c) measures.mean_velocity[c] = sums[c] / grid_.size();
  measures.kinetic_energy_per_density = sums[3] * grid_.cell_volume();
  measures.max_speed = largest[0];
  measures.max_divergence = largest[0] > 0 ? largest[1] * grid_.spacing[0] / largest[0] : 0;
  if (grid_.walls) measure_tractions(measures);
  return measures;
}

/// The shear tractions are those of the discrete equations, so that plates and applied forces balance to
/// round-off; the normal ones are the mean pressure at the plates, of mean zero over the fluid.
void Flow::measure_tractions(FlowMeasures &measures) const
{
  const int n = grid_.cells[2];
  std::vector<double> sums(10 + n);    // u, v next to each plate; direct forces; f_w of each plane
  for_each_cell(brick(), [&](int i, int j, int k) {
    for (int c = 0; c < 2; ++c) {
      if (k == 0) sums[c] += velocity_[c](i, j, k);
      if (k == n - 1) sums[2 + c] += velocity_[c](i, j, k);
    }
    sums[10 + k] += force_[2](i, j, k);
  });
  for (int c = 0; c < 3; ++c) {
    sums[4 + c] = lower_direct_[c];
    sums[7 + c] = upper_direct_[c];
  }
  sum_over_ranks(sums, decomposition_.comm);

  const double per_plane = 1.0 / (double(grid_.cells[0]) * grid_.cells[1]), h = grid_.spacing[2];
  double pressure = 0, mean = 0;
  for (int k = 1; k < n; ++k) {
    pressure += h * (sums[10 + k] * per_plane + drive.body[2]);
    mean += pressure / n;
  }
  for (int c = 0; c < 3; ++c) {
    measures.lower_traction[c] = sums[4 + c] * per_plane * h;
    measures.upper_traction[c] = sums[7 + c] * per_plane * h;
  }
  for (int c = 0; c < 2; ++c) {
    measures.lower_traction[c] += 2 * viscosity_ / h * (sums[c] * per_plane - drive.walls.lower[c]);
    measures.upper_traction[c] +=
        2 * viscosity_ / h * (sums[2 + c] * per_plane - drive.walls.upper[c]);
  }
  const double weight = h / 2 * drive.body[2];    // of the half cells at the plates
  measures.lower_traction[2] += weight + mean;
  measures.upper_traction[2] += weight + pressure - mean;
}

Traffic Flow::traffic() const
{
  const Traffic transforms = solver_.traffic(), halo = halo_.traffic();
  return {transforms.messages + halo.messages, transforms.bytes + halo.bytes};
}

std::size_t Flow::bytes() const
{
  return force_.bytes() + velocity_.bytes() + pressure_.bytes() + halo_.bytes() + solver_.bytes();
}

}    // namespace fluid
