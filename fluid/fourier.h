#pragma once

#include "fluid/pencils.h"
#include "fluid/redistribution.h"
#include "fluid/transposition.h"

namespace fluid {

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

/// Real transform of rows of the same length, two rows at a time as real and imaginary part of a
/// complex one: FFTW's complex transforms use SIMD, its real ones mostly do not.
class RowTransform {
 public:
  RowTransform() = default;
  explicit RowTransform(int length);

  /// Rows lo <= j < hi of plane k; `modes` has length/2 + 1 of each.
  void forward(const View<double> &values, const View<Complex> &modes, int lo, int hi, int k) const;
  void backward(const View<Complex> &modes, const View<double> &values, int lo, int hi,
                int k) const;

 private:
  static constexpr int pairs = 4;

  template <typename Join, typename Split>
  void transform(const Plan &plan, int lo, int hi, Join join, Split split) const;

  int length_ = 0;
  Buffer<Complex> rows_;
  Plan forward_, backward_;
};

/// Distributed real transform in x and y of up to three components at a time, unnormalised. Grid
/// values live on the decomposition's bricks, modes on `modes()`: a box of (kx, ky) with all of z.
/// Between a transform forward and one backward spectrum() holds the modes. Otherwise nothing is
/// kept, and the memory is lent to others.
class Fourier {
 public:
  Fourier(const Fourier &) = delete;
  Fourier &operator=(const Fourier &) = delete;

  /// It takes memory for at least `lent` numbers.
  Fourier(const Grid &grid, const Decomposition &decomposition, std::size_t lent = 0);

  /// Memory to use between transforms.
  double *lent() const { return work_.data(); }

  /// Modes (kx, ky) this rank holds, with all of z.
  const Box &modes() const { return modes_.box(); }

  /// The modes of every rank.
  const std::vector<Box> &mode_bricks() const { return mode_bricks_; }

  /// Transforms the values on this rank's brick; the result stands in spectrum().
  template <std::size_t N> void forward(const std::array<View<double>, N> &values);

  /// Transforms spectrum() back to this rank's brick; overwrites spectrum().
  template <std::size_t N> void backward(const std::array<View<double>, N> &values);

  View<Complex> spectrum(int component) const { return modes_[component]; }

  Traffic traffic() const;
  std::size_t bytes() const;

 private:
  template <std::size_t N>
  std::array<View<double>, N> rows(const std::array<View<double>, N> &values) const;
  View<Complex> x_plane(int component, int k) const;
  View<Complex> y_plane(int component, int k) const;
  void transform_y(const Plan &plan, const View<Complex> &plane, int k) const;

  Box real_x_, x_, y_;
  std::vector<Box> mode_bricks_;
  Buffer<double> work_;    ///< modes_ and real_
  Components<Complex, 3> modes_;
  Redistribution to_x_;
  Transposition x_to_y_, y_to_z_;
  VectorField real_;
  bool y_in_place_;          ///< in modes_; else in plane_
  Buffer<Complex> plane_;    ///< the one being transformed
  RowTransform x_transform_;
  Plan y_forward_, y_backward_;
};

}    // namespace fluid
