#include "fluid/banded.h"
#include "fluid/plate_modes.h"

#include <algorithm>

namespace fluid {

namespace {

/// With Fourier modes in x and y the velocity splits into the part along the wave vector, the part
/// across it, and w. The part across obeys a Helmholtz equation in z (tridiagonal). Continuity
/// gives the part along from w, momentum along gives the pressure, and what is left for w is the
/// pentadiagonal symmetric positive definite system
///   (q A_w + D^T A_c D) w = q f_w + kappa h D^T f_along,   q = (kappa h)^2,
/// where A_w, A_c are the Helmholtz operators on faces and centres and D the difference in z. A
/// source s adds s / kappa to the part along, and -A_c s / kappa to f_along.
class CoupledModes : public PlateModes {
 public:
  CoupledModes(const Grid &grid, const Box &modes, double viscosity, double shift) :
      PlateModes(grid, modes, viscosity, shift), across_(grid.cells[2]), along_(grid.cells[2]),
      vertical_(grid.cells[2])
  {
  }

 private:
  void solve_block(const Block &block, const std::array<View<Complex>, 3> &spectrum,
                   const View<Complex> *pressure, const View<Complex> *source) override
  {
    const int n = grid_.cells[2];
    const ImageFactors images = grid_.plate_conditions.factors();
    const double h = grid_.spacing[2], b = viscosity_ / (h * h);
    const double scale = this->scale();

    const Lanes &kappa = block.kappa();
    const Lanes a = shift_ + viscosity_ * kappa * kappa, q = kappa * kappa * h * h;
    const Lanes scale_w = q * scale, kappa_h = kappa * h, inverse_kappa_h = 1 / kappa_h;

    const Lanes inverse_kappa = 1 / kappa;
    const auto driven = [&](int k) {
      return (scale * inverse_kappa) * block.load(*source, std::clamp(k, 0, n - 1));
    };
    const auto along_driven = [&](int k) {
      const Modes below = k > 0 ? driven(k - 1) : images.lower * driven(k);
      const Modes above = k < n - 1 ? driven(k + 1) : images.upper * driven(k);
      return (a + 2 * b) * driven(k) - b * (below + above);
    };

    across_.begin(a, b, images);
    vertical_.begin(a, q, b, images);
    for (int k = 0; k < n; ++k) {
      const Tangential force = block.load_tangential(spectrum, k, scale);
      along_.set(k, source ? force.along - along_driven(k) : force.along);
      across_.set(k, force.across);
      across_.factor_row(k);
      across_.eliminate(k);
      if (k == 0) continue;
      const Modes w = block.load(spectrum[2], k);
      vertical_.set(k, scale_w * w + kappa_h * (along_[k] - along_[k - 1]));
      vertical_.factor_row(k);
      vertical_.eliminate(k);
    }

    const auto continuity = [&](int k) {
      return inverse_kappa_h * (vertical_[k] - vertical_[k + 1]);
    };
    for (int k = n - 1; k >= 0; --k) {
      across_.substitute(k);
      if (k > 0) vertical_.substitute(k);
      const Modes along = source ? continuity(k) + driven(k) : continuity(k);
      block.store_tangential({along, across_[k]}, spectrum, k);
      block.store(vertical_[k], spectrum[2], k);
    }
    if (!pressure) return;

    for (int k = 0; k < n; ++k) {
      const Modes here = continuity(k);
      const Modes below = k > 0 ? continuity(k - 1) : images.lower * here;
      const Modes above = k < n - 1 ? continuity(k + 1) : images.upper * here;
      const Modes applied = (a + 2 * b) * here - b * (below + above);
      block.store(inverse_kappa * (applied - along_[k]), *pressure, k);
    }
  }

  TridiagonalLines<lanes> across_;
  ComplexLines<lanes> along_;
  PentadiagonalLines<lanes> vertical_;
};

}    // namespace

std::unique_ptr<ModeSolver> make_coupled_modes(const Grid &grid, const Box &modes, double viscosity,
                                               double shift)
{
  return std::make_unique<CoupledModes>(grid, modes, viscosity, shift);
}

}    // namespace fluid
