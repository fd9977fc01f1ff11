#include "fluid/mean_profile.h"

#include "fluid/banded.h"

namespace fluid {

MeanProfile::MeanProfile(const Grid &grid, double viscosity) :
    grid_(grid), viscosity_(viscosity), pressure_(grid.cells[2]), ratio_(grid.cells[2])
{
  velocity_.fill(std::vector<double>(grid.cells[2]));
}

void MeanProfile::solve(const std::array<View<Complex>, 3> &force, double shift,
                        const Forcing &forcing, const View<Complex> *source)
{
  const int n = grid_.cells[2];
  const double h = grid_.spacing[2], b = viscosity_ / (h * h);
  const ImageFactors images = grid_.plate_conditions.factors();
  const double scale = 1.0 / (double(grid_.cells[0]) * grid_.cells[1]);
  for (int c = 0; c < 2; ++c) {
    std::vector<double> &u = velocity_[c];
    for (int k = 0; k < n; ++k) u[k] = force[c](0, 0, k).real() * scale + forcing.body[c];
    u[0] += (1 - images.lower) * b * forcing.plates.lower[c];
    u[n - 1] += (1 - images.upper) * b * forcing.plates.upper[c];
    for (int k = 0; k < n; ++k) {
      const double before = k > 0 ? ratio_[k - 1] : 0;
      const double pivot = shift + b * (2 - end_factor(images, k, n)) - b * before;
      u[k] = (u[k] + (k > 0 ? b * u[k - 1] : 0)) / pivot;
      ratio_[k] = b / pivot;
    }
    for (int k = n - 2; k >= 0; --k) u[k] += ratio_[k] * u[k + 1];
  }

  velocity_[2].assign(n, 0.0);
  if (source) set_vertical(*source, h * scale);

  double mean = 0;
  for (int k = 1; k < n; ++k) {
    const double gradient =
        force[2](0, 0, k).real() * scale + forcing.body[2] + viscous_force(k, shift);
    pressure_[k] = pressure_[k - 1] + h * gradient;
    mean += pressure_[k] / n;
  }
  pressure_offset_ = mean;
}

/// On the mean w.
double MeanProfile::viscous_force(int k, double shift) const
{
  const int n = grid_.cells[2];
  const std::vector<double> &w = velocity_[2];
  const double above = k < n - 1 ? w[k + 1] : 0;
  const double h = grid_.spacing[2];
  return viscosity_ / (h * h) * (above - 2 * w[k] + w[k - 1]) - shift * w[k];
}

/// Continuity from plate to plate; what the planes do not lose among each other is taken evenly
/// from all.
void MeanProfile::set_vertical(const View<Complex> &source, double scale)
{
  const int n = grid_.cells[2];
  double total = 0;
  for (int k = 0; k < n; ++k) total += scale * source(0, 0, k).real();
  for (int k = 1; k < n; ++k)
    velocity_[2][k] = velocity_[2][k - 1] + scale * source(0, 0, k - 1).real() - total / n;
}

void MeanProfile::store(const std::array<View<Complex>, 3> &velocity,
                        const View<Complex> *pressure) const
{
  for (int k = 0; k < grid_.cells[2]; ++k) {
    for (int c = 0; c < 3; ++c) velocity[c](0, 0, k) = velocity_[c][k];
    if (pressure) (*pressure)(0, 0, k) = pressure_[k] - pressure_offset_;
  }
}

}    // namespace fluid
