#include "fluid/banded.h"
#include "fluid/plate_modes.h"

#include <cassert>

namespace fluid {

namespace {

/// With s the shift, p the pressure of the solve before, * the velocity before the projection:
///   (s - viscosity lap) u* + grad p = f,   lap phi = s div u*,   u = u* - grad phi / s,
///   p += phi - viscosity div u*.
class ProjectedModes : public PlateModes {
 public:
  ProjectedModes(const Grid &grid, const Box &modes, double viscosity, double shift) :
      PlateModes(grid, modes, viscosity, shift), across_(grid.cells[2]), along_(grid.cells[2]),
      vertical_(grid.cells[2] - 1), potential_(grid.cells[2]), pressure_(grid.cells[2]),
      kept_(modes)
  {
  }

  const Components<Complex, 1> *kept_pressure() const override { return &kept_; }

  void solve(const std::array<View<Complex>, 3> &spectrum, const Forcing &forcing,
             const View<Complex> * /*pressure*/, const View<Complex> *source) override
  {
    assert(!source);
    const View<Complex> kept = kept_[0];
    PlateModes::solve(spectrum, forcing, &kept, source);
  }

 private:
  void solve_block(const Block &block, const std::array<View<Complex>, 3> &spectrum,
                   const View<Complex> *pressure, const View<Complex> * /*source*/) override
  {
    const int n = grid_.cells[2];
    const ImageFactors images = grid_.plate_conditions.factors();
    const double h = grid_.spacing[2], b = viscosity_ / (h * h);
    const double scale = this->scale();
    const Lanes &kappa = block.kappa();
    const Lanes a = shift_ + viscosity_ * kappa * kappa;
    const View<Complex> &kept = *pressure;

    for (int k = 0; k < n; ++k) {
      pressure_.set(k, block.load(kept, k));
      const Tangential force = block.load_tangential(spectrum, k, scale);
      across_.set(k, force.across);
      along_.set(k, force.along + kappa * pressure_[k]);
      if (k == 0) continue;
      const Modes w = block.load(spectrum[2], k);
      vertical_.set(k - 1, scale * w - (1 / h) * (pressure_[k] - pressure_[k - 1]));
    }
    across_.factor(a, b, images);
    across_.solve();
    along_.factor(a, b, images);
    along_.solve();
    vertical_.factor(a, b, zero_value);
    vertical_.solve();

    for (int k = 0; k < n; ++k) {
      Modes divergence = kappa * along_[k];
      if (k < n - 1) divergence = divergence + (1 / h) * vertical_[k];
      if (k > 0) divergence = divergence - (1 / h) * vertical_[k - 1];
      potential_.set(k, -shift_ * divergence);
      pressure_.set(k, pressure_[k] - viscosity_ * divergence);
    }
    potential_.factor(kappa * kappa, 1 / (h * h), zero_slope);
    potential_.solve();

    const Lanes slope = kappa / shift_;
    const double step = 1 / (h * shift_);
    for (int k = 0; k < n; ++k) {
      block.store(pressure_[k] + potential_[k], kept, k);
      block.store_tangential({along_[k] + slope * potential_[k], across_[k]}, spectrum, k);
      Modes w = Modes::constant(0);
      if (k > 0) w = vertical_[k - 1] - step * (potential_[k] - potential_[k - 1]);
      block.store(w, spectrum[2], k);
    }
  }

  TridiagonalLines<lanes> across_, along_, vertical_, potential_;
  ComplexLines<lanes> pressure_;
  Components<Complex, 1> kept_;
};

}    // namespace

std::unique_ptr<ModeSolver> make_projected_modes(const Grid &grid, const Box &modes,
                                                 double viscosity, double shift)
{
  return std::make_unique<ProjectedModes>(grid, modes, viscosity, shift);
}

}    // namespace fluid
