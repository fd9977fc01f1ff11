#include "fluid/lanes.h"
#include "fluid/mode_solver.h"
#include "fluid/wavenumbers.h"

namespace fluid {

namespace {

// Columns of modes are transformed in z and solved in blocks that fit into the cache.
constexpr int groups = 4, width = groups * lanes;
// An odd number of cache lines: powers of two would share few sets.
constexpr int stride = width + 4;

/// With all directions transformed, momentum and continuity are f = a u + conj(d) p and d.u = -s,
/// where d is minus the symbol of the difference from faces to centres (Wavenumbers), a that of the
/// Helmholtz operator and s the source.
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
    const int nz = grid.cells[2];
    for (auto &component : block_) component = Buffer<Complex>(std::size_t(stride) * nz);
    auto *p = raw(block_[0].data());
    const auto plan = [&](int sign) {
      return Plan(fftw_plan_many_dft(1, &nz, width, p, nullptr, stride, 1, p, nullptr, stride, 1,
                                     sign, FFTW_ESTIMATE));
    };
    forward_ = plan(FFTW_FORWARD);
    backward_ = plan(FFTW_BACKWARD);
  }

  void set_shift(double shift) override { shift_ = shift; }

  void solve(const std::array<View<Complex>, 3> &spectrum, const Forcing &forcing,
             const View<Complex> *pressure, const View<Complex> *source) override
  {
    const int columns = modes_.empty() ? 0 : modes_.extent(0) * modes_.extent(1);
    for (int first = 0; first < columns; first += width) {
      const int count = std::min(width, columns - first);
      for (int c = 0; c < 3; ++c) {
        load(spectrum[c], first, count, block_[c]);
        transform(forward_, block_[c]);
      }
      if (source) {
        load(*source, first, count, block_[3]);
        transform(forward_, block_[3]);
      }
      for (int group = 0; group < groups; ++group) project(first, count, group, source != nullptr);
      if (first == 0 && modes_.contains({0, 0, 0})) set_mean(forcing);
      for (int c = 0; c < 3; ++c) {
        transform(backward_, block_[c]);
        store(block_[c], first, count, spectrum[c]);
      }
      if (pressure) {
        transform(backward_, block_[3]);
        store(block_[3], first, count, *pressure);
      }
    }
  }

 private:
  static fftw_complex *raw(Complex *p) { return reinterpret_cast<fftw_complex *>(p); }

  static void transform(const Plan &plan, const Buffer<Complex> &block)
  {
    fftw_execute_dft(plan.get(), raw(block.data()), raw(block.data()));
  }

  /// Columns first, first + 1, ... of the plane (kx, ky); the block's other columns are zero.
  void load(const View<Complex> &from, int first, int count, const Buffer<Complex> &block) const
  {
    for (int k = 0; k < grid_.cells[2]; ++k) {
      Complex *row = block.data() + std::ptrdiff_t(k) * stride;
      std::copy_n(&from(modes_.lo[0], modes_.lo[1], k) + first, count, row);
      std::fill(row + count, row + width, 0);
    }
  }

  void store(const Buffer<Complex> &block, int first, int count, const View<Complex> &to) const
  {
    for (int k = 0; k < grid_.cells[2]; ++k)
      std::copy_n(block.data() + std::ptrdiff_t(k) * stride, count,
                  &to(modes_.lo[0], modes_.lo[1], k) + first);
  }

  void project(int first, int count, int group, bool has_source) const
  {
    Modes dx, dy;
    Lanes square_xy;
    for (int m = 0; m < lanes; ++m) {
      const int column = first + std::min(group * lanes + m, count - 1);
      const int i = column % modes_.extent(0), j = column / modes_.extent(0);
      dx.set(m, x_.kappa[i] * x_.half_shift[i]);
      dy.set(m, y_.kappa[j] * y_.half_shift[j]);
      square_xy[m] = x_.kappa[i] * x_.kappa[i] + y_.kappa[j] * y_.kappa[j];
    }
    const double normalisation = 1.0 / grid_.size();
    for (int kz = 0; kz < grid_.cells[2]; ++kz) {
      const std::ptrdiff_t offset = std::ptrdiff_t(kz) * stride + group * lanes;
      const auto f = [&](int c) { return Modes::load(block_[c].data() + offset); };
      const Modes dz = Modes::constant(z_.kappa[kz] * z_.half_shift[kz]);
      const Lanes square = square_xy + z_.kappa[kz] * z_.kappa[kz];
      const Lanes symbol = shift_ + viscosity_ * square;
      const Lanes inverse = (symbol > 0).select(normalisation / symbol, 0.0);
      const Lanes inverse_square = (square > 0).select(1 / square, 0.0);

      const Modes fx = f(0), fy = f(1), fz = f(2);
      Modes p = inverse_square * (dx * fx + dy * fy + dz * fz);
      Modes ux = inverse * (fx - conj(dx) * p), uy = inverse * (fy - conj(dy) * p),
            uz = inverse * (fz - conj(dz) * p);
      if (has_source) {
        const Modes potential = (normalisation * inverse_square) * over_i(f(3));
        ux = ux + conj(dx) * potential;
        uy = uy + conj(dy) * potential;
        uz = uz + conj(dz) * potential;
        p = p - (symbol * inverse_square) * over_i(f(3));
      }
      ux.store(block_[0].data() + offset);
      uy.store(block_[1].data() + offset);
      uz.store(block_[2].data() + offset);
      (normalisation * over_i(p)).store(block_[3].data() + offset);
    }
  }

  void set_mean(const Forcing &forcing) const
  {
    for (int c = 0; c < 3; ++c) {
      Complex &mean = *block_[c].data();
      if (hold_mean_)
        mean = forcing.mean[c];
      else if (shift_ > 0)
        mean += forcing.body[c] / shift_;
    }
  }

  Grid grid_;
  Box modes_;
  double viscosity_, shift_;
  bool hold_mean_;
  Wavenumbers x_, y_, z_;
  std::array<Buffer<Complex>, 4> block_;    ///< force, then velocity; source, then pressure
  Plan forward_, backward_;
};

}    // namespace

std::unique_ptr<ModeSolver> make_periodic_modes(const Grid &grid, const Box &modes,
                                                double viscosity, double shift, bool hold_mean)
{
  return std::make_unique<PeriodicModes>(grid, modes, viscosity, shift, hold_mean);
}

}    // namespace fluid
