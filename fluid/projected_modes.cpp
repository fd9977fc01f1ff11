#include "lanes.h"
#include "mean_profile.h"
#include "mode_solver.h"

#include <tuple>

namespace fluid {

namespace {

/// With s the shift, p the pressure of the solve before, * the velocity before the projection:
///   (s - viscosity lap) u* + grad p = f,   lap phi = s div u*,   u = u* - grad phi / s,
///   p += phi - viscosity div u*.
/// As in WalledModes, the part of the velocity along the wave vector is taken times i, which makes all real.
class ProjectedModes : public ModeSolver {
 public:
  ProjectedModes(const Grid &grid, const Box &modes, double viscosity, double shift) :
      grid_(grid), modes_(modes), viscosity_(viscosity), shift_(shift),
      x_(grid.cells[0], grid.spacing[0], modes.lo[0], modes.hi[0]),
      y_(grid.cells[1], grid.spacing[1], modes.lo[1], modes.hi[1]), across_(grid.cells[2]),
      along_(grid.cells[2]), vertical_(grid.cells[2] - 1), potential_(grid.cells[2]),
      pressure_(grid.cells[2]), mean_(grid, viscosity), kept_(modes)
  {
  }

  void set_shift(double shift) override { shift_ = shift; }
  const Components<Complex, 1> *kept_pressure() const override { return &kept_; }

  void solve(const std::array<View<Complex>, 3> &spectrum, const Drive &drive,
             const View<Complex> *) override
  {
    const bool mean = modes_.contains({0, 0, 0});
    if (mean) mean_.solve(spectrum, shift_, drive);
    for (int ky = modes_.lo[1]; ky < modes_.hi[1]; ++ky)
      for (int kx = modes_.lo[0]; kx < modes_.hi[0]; kx += lanes)
        solve_block(spectrum, kx, ky, std::min(lanes, modes_.hi[0] - kx));
    const View<Complex> pressure = kept_[0];
    if (mean) mean_.store(spectrum, &pressure);
  }

 private:
  void solve_block(const std::array<View<Complex>, 3> &spectrum, int kx, int ky, int count)
  {
    const int n = grid_.cells[2];
    const double h = grid_.spacing[2], b = viscosity_ / (h * h);
    const double scale = 1.0 / (double(grid_.cells[0]) * grid_.cells[1]);
    const WaveVectors wave(x_, y_, kx - modes_.lo[0], ky - modes_.lo[1], count);
    const Lanes a = shift_ + viscosity_ * wave.kappa * wave.kappa;
    const View<Complex> kept = kept_[0];

    for (int k = 0; k < n; ++k) load(kept, kx, ky, k, count, pressure_.re[k], pressure_.im[k]);
    for (int k = 0; k < n; ++k) {
      Lanes u_re, u_im, v_re, v_im;
      load(spectrum[0], kx, ky, k, count, u_re, u_im);
      load(spectrum[1], kx, ky, k, count, v_re, v_im);
      wave.to_centres(u_re, u_im, v_re, v_im);
      across_.re[k] = scale * (wave.x * v_re - wave.y * u_re);
      across_.im[k] = scale * (wave.x * v_im - wave.y * u_im);
      along_.re[k] = -scale * (wave.x * u_im + wave.y * v_im) + wave.kappa * pressure_.re[k];
      along_.im[k] = scale * (wave.x * u_re + wave.y * v_re) + wave.kappa * pressure_.im[k];
      if (k == 0) continue;
      Lanes w_re, w_im;
      load(spectrum[2], kx, ky, k, count, w_re, w_im);
      vertical_.re[k - 1] = scale * w_re - (pressure_.re[k] - pressure_.re[k - 1]) / h;
      vertical_.im[k - 1] = scale * w_im - (pressure_.im[k] - pressure_.im[k - 1]) / h;
    }
    across_.factor(a, b);
    across_.solve();
    along_.factor(a, b);
    along_.solve();
    vertical_.factor(a, b, ColumnEnds::zero);
    vertical_.solve();

    const auto divergence = [&](const std::vector<Lanes> &along, const std::vector<Lanes> &w,
                                int k) -> Lanes {
      Lanes sum = wave.kappa * along[k];
      if (k < n - 1) sum += w[k] / h;
      if (k > 0) sum -= w[k - 1] / h;
      return sum;
    };
    for (int k = 0; k < n; ++k) {
      const Lanes re = divergence(along_.re, vertical_.re, k),
                  im = divergence(along_.im, vertical_.im, k);
      potential_.re[k] = -shift_ * re;
      potential_.im[k] = -shift_ * im;
      pressure_.re[k] -= viscosity_ * re;
      pressure_.im[k] -= viscosity_ * im;
    }
    potential_.factor(wave.kappa * wave.kappa, 1 / (h * h), ColumnEnds::no_flux);
    potential_.solve();

    for (int k = 0; k < n; ++k) {
      const auto &[re, im] = std::tie(potential_.re, potential_.im);
      store(kept, kx, ky, k, count, pressure_.re[k] + re[k], pressure_.im[k] + im[k]);
      const Lanes slope = wave.kappa / shift_;
      const Lanes along_re = along_.im[k] + slope * im[k], along_im = -along_.re[k] - slope * re[k];
      Lanes u_re = wave.x * along_re - wave.y * across_.re[k],
            u_im = wave.x * along_im - wave.y * across_.im[k];
      Lanes v_re = wave.y * along_re + wave.x * across_.re[k],
            v_im = wave.y * along_im + wave.x * across_.im[k];
      wave.to_faces(u_re, u_im, v_re, v_im);
      store(spectrum[0], kx, ky, k, count, u_re, u_im);
      store(spectrum[1], kx, ky, k, count, v_re, v_im);
      Lanes w_re = Lanes::Zero(), w_im = Lanes::Zero();
      if (k > 0) {
        w_re = vertical_.re[k - 1] - (re[k] - re[k - 1]) / (h * shift_);
        w_im = vertical_.im[k - 1] - (im[k] - im[k - 1]) / (h * shift_);
      }
      store(spectrum[2], kx, ky, k, count, w_re, w_im);
    }
  }

  Grid grid_;
  Box modes_;
  double viscosity_, shift_;
  Wavenumbers x_, y_;
  HelmholtzColumns<lanes> across_, along_, vertical_, potential_;
  Columns<lanes> pressure_;
  MeanProfile mean_;
  Components<Complex, 1> kept_;
};

}    // namespace

std::unique_ptr<ModeSolver> make_projected_modes(const Grid &grid, const Box &modes,
                                                 double viscosity, double shift)
{
  return std::make_unique<ProjectedModes>(grid, modes, viscosity, shift);
}

}    // namespace fluid
