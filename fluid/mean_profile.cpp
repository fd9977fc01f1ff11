#include "fluid/mean_profile.h"

#include "fluid/banded.h"

namespace fluid {

MeanProfile::MeanProfile(const Grid &grid, double viscosity) :
    grid_(grid), viscosity_(viscosity), pressure_(grid.cells[2]), ratio_(grid.cells[2])
{
  velocity_.fill(std::vector<double>(grid.cells[2]));
}

void MeanProfile::solve(const std::array<View<Complex>, 3> &force, double shift,
                        const Forcing &forcing)
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

  double mean = 0;
  for (int k = 1; k < n; ++k) {
    const double gradient = force[2](0, 0, k).real() * scale + forcing.body[2];
    pressure_[k] = pressure_[k - 1] + h * gradient;
    mean += pressure_[k] / n;
  }
  pressure_offset_ = mean;
}

void MeanProfile::store(const std::array<View<Complex>, 3> &velocity,
                        const View<Complex> *pressure) const
{
  for (int k = 0; k < grid_.cells[2]; ++k) {
    for (int c = 0; c < 2; ++c) velocity[c](0, 0, k) = velocity_[c][k];
    velocity[2](0, 0, k) = 0;
    if (pressure) (*pressure)(0, 0, k) = pressure_[k] - pressure_offset_;
  }
}

}    // namespace fluid
