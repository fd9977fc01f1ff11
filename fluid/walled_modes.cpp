#include "banded.h"
#include "mode_solver.h"
#include "wavenumbers.h"

namespace fluid {

namespace {

// Modes are solved in blocks of neighbours in the plane (kx, ky), one per lane.
constexpr int lanes = 8;
using Lanes = Lane<lanes>;
using Modes = ComplexLane<lanes>;

/// With Fourier modes in x and y the velocity splits into the part along the wave vector, the part across
/// it, and w. The part across obeys a Helmholtz equation in z (tridiagonal). Continuity gives the part along
/// from w, momentum along gives the pressure, and what is left for w is the pentadiagonal symmetric positive
/// definite system
///   (q A_w + D^T A_c D) w = q f_w + kappa h D^T f_along,   q = (kappa h)^2,
/// where A_w, A_c are the Helmholtz operators on faces and centres and D the difference in z.
class WalledModes : public ModeSolver {
 public:
  WalledModes(const Grid &grid, const Box &modes, double viscosity, double shift) :
      grid_(grid), modes_(modes), viscosity_(viscosity), shift_(shift),
      x_(grid.cells[0], grid.spacing[0], modes.lo[0], modes.hi[0]),
      y_(grid.cells[1], grid.spacing[1], modes.lo[1], modes.hi[1]), across_(grid.cells[2]),
      along_(grid.cells[2]),
      vertical_(grid.cells[2]), mean_velocity_{std::vector<double>(grid.cells[2]),
                                               std::vector<double>(grid.cells[2])},
      mean_pressure_(grid.cells[2])
  {
  }

  void set_shift(double shift) override { shift_ = shift; }

  void solve(const std::array<View<Complex>, 3> &spectrum, const Drive &drive,
             const View<Complex> *pressure) override
  {
    const bool mean = modes_.contains({0, 0, 0});
    if (mean) solve_mean(spectrum, drive);
    const int columns = modes_.empty() ? 0 : modes_.extent(0) * modes_.extent(1);
    for (int first = 0; first < columns; first += lanes)
      solve_block(spectrum, pressure, first, std::min(lanes, columns - first));
    if (mean) store_mean(spectrum, pressure);
  }

 private:
  double over_h2() const { return viscosity_ / (grid_.spacing[2] * grid_.spacing[2]); }
  double normalisation() const { return 1.0 / (double(grid_.cells[0]) * grid_.cells[1]); }

  /// Mean profiles of u, v and p (that of w is zero): the plates drive the flow through these only.
  void solve_mean(const std::array<View<Complex>, 3> &spectrum, const Drive &drive)
  {
    const int n = grid_.cells[2];
    const double b = over_h2(), scale = normalisation();
    Lanes diagonal_shift;
    diagonal_shift.setConstant(shift_);
    across_.factor(diagonal_shift, b);
    for (int c = 0; c < 2; ++c) {
      for (int k = 0; k < n; ++k) {
        across_.re[k].setConstant(spectrum[c](0, 0, k).real() * scale + drive.body[c]);
        across_.im[k].setZero();
      }
      across_.re[0] += 2 * b * drive.walls.lower[c];
      across_.re[n - 1] += 2 * b * drive.walls.upper[c];
      across_.solve();
      for (int k = 0; k < n; ++k) mean_velocity_[c][k] = across_.re[k][0];
    }

    double mean = 0;
    for (int k = 1; k < n; ++k) {
      const double gradient = spectrum[2](0, 0, k).real() * scale + drive.body[2];
      mean_pressure_[k] = mean_pressure_[k - 1] + grid_.spacing[2] * gradient;
      mean += mean_pressure_[k] / n;
    }
    mean_pressure_offset_ = mean;
  }

  /// The mean mode goes through solve_block as a lane without meaning and gets its values here.
  void store_mean(const std::array<View<Complex>, 3> &spectrum, const View<Complex> *pressure) const
  {
    for (int k = 0; k < grid_.cells[2]; ++k) {
      for (int c = 0; c < 2; ++c) spectrum[c](0, 0, k) = mean_velocity_[c][k];
      spectrum[2](0, 0, k) = 0;
      if (pressure) (*pressure)(0, 0, k) = mean_pressure_[k] - mean_pressure_offset_;
    }
  }

  /// Modes first, first + 1, ... of the plane.
  void solve_block(const std::array<View<Complex>, 3> &spectrum, const View<Complex> *pressure,
                   int first, int count)
  {
    const int n = grid_.cells[2];
    const double h = grid_.spacing[2], b = over_h2(), scale = normalisation();

    Lanes along_x = Lanes::Ones(), along_y = Lanes::Zero(), kappa = Lanes::Ones();
    Modes ex = Modes::constant(1), ey = Modes::constant(1);    // from faces to centres
    for (int m = 0; m < count; ++m) {
      const int i = (first + m) % modes_.extent(0), j = (first + m) / modes_.extent(0);
      const double x = x_.kappa[i], y = y_.kappa[j], magnitude = std::hypot(x, y);
      ex.set(m, x_.half_shift[i]);
      ey.set(m, y_.half_shift[j]);
      if (magnitude == 0) continue;
      kappa[m] = magnitude;
      along_x[m] = x / magnitude;
      along_y[m] = y / magnitude;
    }
    const Lanes a = shift_ + viscosity_ * kappa * kappa, q = kappa * kappa * h * h;
    const Lanes scale_w = q * scale, kappa_h = kappa * h, inverse_kappa_h = 1 / kappa_h;
    const auto at = [&](const View<Complex> &view, int k) {
      return &view(modes_.lo[0], modes_.lo[1], k) + first;
    };

    // The part along the wave vector is taken times i, which makes the system for w real.
    across_.begin(a, b);
    vertical_.begin(a, q, b);
    for (int k = 0; k < n; ++k) {
      const Modes u = ex * Modes::load(at(spectrum[0], k), count);
      const Modes v = ey * Modes::load(at(spectrum[1], k), count);
      along_.set(k, times_i(scale * (along_x * u + along_y * v)));
      across_.set(k, scale * (along_x * v - along_y * u));
      across_.factor_row(k);
      across_.eliminate(k);
      if (k == 0) continue;
      const Modes w = Modes::load(at(spectrum[2], k), count);
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
      const Modes along = over_i(continuity(k)), across = across_[k];
      (conj(ex) * (along_x * along - along_y * across)).store(at(spectrum[0], k), count);
      (conj(ey) * (along_y * along + along_x * across)).store(at(spectrum[1], k), count);
      vertical_[k].store(at(spectrum[2], k), count);
    }
    if (!pressure) return;

    const Lanes inverse_kappa = 1 / kappa;
    for (int k = 0; k < n; ++k) {
      const Modes here = continuity(k);
      const Modes below = k > 0 ? continuity(k - 1) : -here;
      const Modes above = k < n - 1 ? continuity(k + 1) : -here;
      const Modes applied = (a + 2 * b) * here - b * (below + above);
      (inverse_kappa * (applied - along_[k])).store(at(*pressure, k), count);
    }
  }

  Grid grid_;
  Box modes_;
  double viscosity_, shift_;
  Wavenumbers x_, y_;
  HelmholtzColumns<lanes> across_;
  Columns<lanes> along_;
  VerticalColumns<lanes> vertical_;
  std::array<std::vector<double>, 2> mean_velocity_;
  std::vector<double> mean_pressure_;
  double mean_pressure_offset_ = 0;
};

}    // namespace

std::unique_ptr<ModeSolver> make_walled_modes(const Grid &grid, const Box &modes, double viscosity,
                                              double shift)
{
  return std::make_unique<WalledModes>(grid, modes, viscosity, shift);
}

}    // namespace fluid
