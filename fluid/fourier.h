#pragma once

#include "pencils.h"
#include "redistribution.h"

#include <complex>

namespace fluid {

using Complex = std::complex<double>;

/// Smallest number of points >= n without prime factors above 7: FFTW is fast for these.
int fast_size(int n);

/// Owns an FFTW plan.
class Plan {
 public:
  Plan() = default;
  explicit Plan(fftw_plan plan) : plan_(plan) {}
  fftw_plan get() const { return plan_.get(); }

 private:
  struct Destroy {
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
  };
  std::unique_ptr<fftw_plan_s, Destroy> plan_;
};

/// Distributed real transform in x and y of up to three components at a time, unnormalised. Grid values
/// live on the decomposition's bricks, modes on `modes()`: a box of (kx, ky) with all of z.
class Fourier {
 public:
  Fourier(const Fourier &) = delete;
  Fourier &operator=(const Fourier &) = delete;

  /// `storage` is the box over which the value arrays are stored (the brick with its ghost layers).
  Fourier(const Grid &grid, const Decomposition &decomposition, const Box &storage);

  /// Modes (kx, ky) this rank holds, with all of z.
  const Box &modes() const { return z_->box(); }

  /// The modes of every rank.
  const std::vector<Box> &mode_bricks() const { return mode_bricks_; }

  /// Transforms the values on this rank's brick; the result stands in spectrum().
  template <std::size_t N> void forward(const std::array<View<double>, N> &values);

  /// Transforms spectrum() back to this rank's brick; overwrites spectrum().
  template <std::size_t N> void backward(const std::array<View<double>, N> &values);

  View<Complex> spectrum(int component) const { return (*z_)[component]; }

  Traffic traffic() const;
  std::size_t bytes() const;

 private:
  using Modes = Components<Complex, 3>;

  View<double> rows(const View<double> &values, int component) const;

  Redistribution<double> to_x_;
  Redistribution<Complex> x_to_y_, y_to_z_;
  VectorField real_;
  std::array<Modes, 3> storage_;
  const Modes *x_, *y_, *z_;
  Box row_box_;
  std::vector<Box> mode_bricks_;
  Plan x_forward_, x_backward_, y_forward_, y_backward_;
};

}    // namespace fluid
