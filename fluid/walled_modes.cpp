#include "banded.h"
#include "mode_solver.h"
#include "wavenumbers.h"

namespace fluid {

namespace {

// Modes of one ky are solved in blocks of neighbouring kx, one per lane.
constexpr int lanes = 8;
using Lanes = Lane<lanes>;

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
      vertical_(grid.cells[2] + 1), mean_velocity_{std::vector<double>(grid.cells[2]),
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
    for (int ky = modes_.lo[1]; ky < modes_.hi[1]; ++ky)
      for (int kx = modes_.lo[0]; kx < modes_.hi[0]; kx += lanes)
        solve_block(spectrum, pressure, kx, ky, std::min(lanes, modes_.hi[0] - kx));
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

  void solve_block(const std::array<View<Complex>, 3> &spectrum, const View<Complex> *pressure,
                   int kx, int ky, int count)
  {
    const int n = grid_.cells[2];
    const double h = grid_.spacing[2], b = over_h2(), scale = normalisation();
    const double y = y_.kappa[ky - modes_.lo[1]];
    const Complex ey = y_.half_shift[ky - modes_.lo[1]];

    Lanes along_x = Lanes::Ones(), along_y = Lanes::Zero(), kappa = Lanes::Ones();
    Lanes ex_re = Lanes::Zero(), ex_im = Lanes::Zero();
    for (int m = 0; m < count; ++m) {
      const double x = x_.kappa[kx - modes_.lo[0] + m], magnitude = std::hypot(x, y);
      ex_re[m] = x_.half_shift[kx - modes_.lo[0] + m].real();
      ex_im[m] = x_.half_shift[kx - modes_.lo[0] + m].imag();
      if (magnitude == 0) continue;
      kappa[m] = magnitude;
      along_x[m] = x / magnitude;
      along_y[m] = y / magnitude;
    }
    const Lanes a = shift_ + viscosity_ * kappa * kappa, q = kappa * kappa * h * h;

    // Faces to centres, then along (times i, which makes the system real) and across the wave vector.
    for (int k = 0; k < n; ++k) {
      Lanes u_re, u_im, v_re, v_im;
      load(spectrum[0], kx, ky, k, count, u_re, u_im);
      load(spectrum[1], kx, ky, k, count, v_re, v_im);
      load(spectrum[2], kx, ky, k, count, vertical_.re[k], vertical_.im[k]);
      rotate(u_re, u_im, ex_re, ex_im);
      rotate(v_re, v_im, Lanes::Constant(ey.real()), Lanes::Constant(ey.imag()));
      across_.re[k] = scale * (along_x * v_re - along_y * u_re);
      across_.im[k] = scale * (along_x * v_im - along_y * u_im);
      along_.re[k] = -scale * (along_x * u_im + along_y * v_im);
      along_.im[k] = scale * (along_x * u_re + along_y * v_re);
    }

    across_.factor(a, b);
    across_.solve();

    for (int k = 1; k < n; ++k) {
      vertical_.re[k] = q * scale * vertical_.re[k] + kappa * h * (along_.re[k] - along_.re[k - 1]);
      vertical_.im[k] = q * scale * vertical_.im[k] + kappa * h * (along_.im[k] - along_.im[k - 1]);
    }
    vertical_.factor(a, q, b);
    vertical_.solve();

    const Lanes inverse_kappa_h = 1 / (kappa * h);
    const auto continuity = [&](const std::vector<Lanes> &w, int k) -> Lanes {
      return (w[k] - w[k + 1]) * inverse_kappa_h;
    };
    if (pressure)
      for (int k = 0; k < n; ++k) {
        const auto momentum = [&](const std::vector<Lanes> &w,
                                  const std::vector<Lanes> &f) -> Lanes {
          Lanes applied = (a + 2 * b) * continuity(w, k);
          applied -= k > 0 ? Lanes(b * continuity(w, k - 1)) : Lanes(-b * continuity(w, k));
          applied -= k < n - 1 ? Lanes(b * continuity(w, k + 1)) : Lanes(-b * continuity(w, k));
          return (applied - f[k]) / kappa;
        };
        store(*pressure, kx, ky, k, count, momentum(vertical_.re, along_.re),
              momentum(vertical_.im, along_.im));
      }

    for (int k = 0; k < n; ++k) {
      const Lanes along_re = continuity(vertical_.im, k), along_im = -continuity(vertical_.re, k);
      Lanes u_re = along_x * along_re - along_y * across_.re[k],
            u_im = along_x * along_im - along_y * across_.im[k];
      Lanes v_re = along_y * along_re + along_x * across_.re[k],
            v_im = along_y * along_im + along_x * across_.im[k];
      rotate(u_re, u_im, ex_re, -ex_im);
      rotate(v_re, v_im, Lanes::Constant(ey.real()), Lanes::Constant(-ey.imag()));
      store(spectrum[0], kx, ky, k, count, u_re, u_im);
      store(spectrum[1], kx, ky, k, count, v_re, v_im);
      store(spectrum[2], kx, ky, k, count, vertical_.re[k], vertical_.im[k]);
    }
  }

  static void load(const View<Complex> &from, int kx, int ky, int k, int count, Lanes &re,
                   Lanes &im)
  {
    const Complex *row = &from(kx, ky, k);
    if (count == lanes) {
      for (int m = 0; m < lanes; ++m) {
        re[m] = row[m].real();
        im[m] = row[m].imag();
      }
      return;
    }
    re.setZero();
    im.setZero();
    for (int m = 0; m < count; ++m) {
      re[m] = row[m].real();
      im[m] = row[m].imag();
    }
  }

  static void store(const View<Complex> &to, int kx, int ky, int k, int count, const Lanes &re,
                    const Lanes &im)
  {
    Complex *row = &to(kx, ky, k);
    if (count == lanes)
      for (int m = 0; m < lanes; ++m) row[m] = {re[m], im[m]};
    else
      for (int m = 0; m < count; ++m) row[m] = {re[m], im[m]};
  }

  static void rotate(Lanes &re, Lanes &im, const Lanes &cosine, const Lanes &sine)
  {
    const Lanes turned = re * cosine - im * sine;
    im = re * sine + im * cosine;
    re = turned;
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
