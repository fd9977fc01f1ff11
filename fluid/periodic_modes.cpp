#include "mode_solver.h"
#include "wavenumbers.h"

namespace fluid {

namespace {

class PeriodicModes : public ModeSolver {
 public:
  PeriodicModes(const Grid &grid, const Box &modes, double viscosity, double shift,
                bool hold_mean) :
      grid_(grid),
      modes_(modes), viscosity_(viscosity), shift_(shift), hold_mean_(hold_mean),
      x_(grid.cells[0], grid.spacing[0], modes.lo[0], modes.hi[0]),
      y_(grid.cells[1], grid.spacing[1], modes.lo[1], modes.hi[1]),
      z_(grid.cells[2], grid.spacing[2], 0, grid.cells[2])
  {
    if (modes.empty()) return;
    const int nz = grid.cells[2], columns = modes.extent(0), plane = columns * modes.extent(1);
    Buffer<Complex> scratch(std::size_t(plane) * nz);
    auto *p = reinterpret_cast<fftw_complex *>(scratch.data());
    const auto plan = [&](int sign) {
      return Plan(fftw_plan_many_dft(1, &nz, columns, p, nullptr, plane, 1, p, nullptr, plane, 1,
                                     sign, FFTW_ESTIMATE));
    };
    forward_ = plan(FFTW_FORWARD);
    backward_ = plan(FFTW_BACKWARD);
  }

  void set_shift(double shift) override { shift_ = shift; }

  void solve(const std::array<View<Complex>, 3> &spectrum, const Drive &drive,
             const View<Complex> *pressure) override
  {
    if (modes_.empty()) return;
    for (int ky = modes_.lo[1]; ky < modes_.hi[1]; ++ky) {
      for (const auto &component : spectrum) transform(forward_, component, ky);
      for (int kz = 0; kz < grid_.cells[2]; ++kz) project_row(spectrum, pressure, ky, kz);
      if (ky == 0 && modes_.contains({0, 0, 0})) drive_mean(spectrum, drive);
      for (const auto &component : spectrum) transform(backward_, component, ky);
      if (pressure) transform(backward_, *pressure, ky);
    }
  }

 private:
  void drive_mean(const std::array<View<Complex>, 3> &spectrum, const Drive &drive) const
  {
    for (int c = 0; c < 3; ++c) {
      Complex &mean = spectrum[c](0, 0, 0);
      if (hold_mean_)
        mean = drive.mean[c];
      else if (shift_ > 0)
        mean += drive.body[c] / shift_;
    }
  }

  void transform(const Plan &plan, const View<Complex> &component, int ky) const
  {
    auto *row = reinterpret_cast<fftw_complex *>(&component(modes_.lo[0], ky, 0));
    fftw_execute_dft(plan.get(), row, row);
  }

  void project_row(const std::array<View<Complex>, 3> &spectrum, const View<Complex> *pressure,
                   int ky, int kz) const
  {
    Complex *u = &spectrum[0](modes_.lo[0], ky, kz), *v = &spectrum[1](modes_.lo[0], ky, kz),
            *w = &spectrum[2](modes_.lo[0], ky, kz);
    Complex *p = pressure ? &(*pressure)(modes_.lo[0], ky, kz) : nullptr;
    const double y = y_.kappa[ky - modes_.lo[1]], z = z_.kappa[kz];
    const Complex ey = y_.half_shift[ky - modes_.lo[1]], ez = z_.half_shift[kz];
    const double normalisation = 1.0 / grid_.size();
    for (int m = 0; m < modes_.extent(0); ++m) {
      const double x = x_.kappa[m], square = x * x + y * y + z * z;
      const Complex ex = x_.half_shift[m];
      const double inverse_square = square > 0 ? 1 / square : 0;
      const double operator_symbol = shift_ + viscosity_ * square;
      const double inverse = operator_symbol > 0 ? normalisation / operator_symbol : 0;
      const Complex fu = times(u[m], ex), fv = times(v[m], ey), fw = times(w[m], ez);
      const Complex divergence = (x * fu + y * fv + z * fw) * inverse_square;
      u[m] = times(fu - x * divergence, std::conj(ex)) * inverse;
      v[m] = times(fv - y * divergence, std::conj(ey)) * inverse;
      w[m] = times(fw - z * divergence, std::conj(ez)) * inverse;
      if (p) p[m] = times(divergence, {0, -1}) * normalisation;
    }
  }

  /// Complex product without the library's treatment of infinities.
  static Complex times(const Complex &a, const Complex &b)
  {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }

  Grid grid_;
  Box modes_;
  double viscosity_, shift_;
  bool hold_mean_;
  Wavenumbers x_, y_, z_;
  Plan forward_, backward_;
};

}    // namespace

std::unique_ptr<ModeSolver> make_periodic_modes(const Grid &grid, const Box &modes,
                                                double viscosity, double shift, bool hold_mean)
{
  return std::make_unique<PeriodicModes>(grid, modes, viscosity, shift, hold_mean);
}

}    // namespace fluid
