#pragma once

#include <Eigen/Dense>
#include <complex>

namespace fluid {

/// The same quantity of several independent modes, one per SIMD lane.
template <int N> using Lane = Eigen::Array<double, N, 1>;

template <int N> struct ComplexLane {
  Lane<N> re, im;

  static ComplexLane constant(const std::complex<double> &z)
  {
    return {Lane<N>::Constant(z.real()), Lane<N>::Constant(z.imag())};
  }

  /// The first `count` lanes; the others are zero.
  static ComplexLane load(const std::complex<double> *from, int count = N)
  {
    ComplexLane z;
    if (count == N) {
      for (int m = 0; m < N; ++m) z.set(m, from[m]);
    } else {
      z = constant(0);
      for (int m = 0; m < count; ++m) z.set(m, from[m]);
    }
    return z;
  }

  void store(std::complex<double> *to, int count = N) const
  {
    if (count == N)
      for (int m = 0; m < N; ++m) to[m] = {re[m], im[m]};
    else
      for (int m = 0; m < count; ++m) to[m] = {re[m], im[m]};
  }

  void set(int m, const std::complex<double> &z)
  {
    re[m] = z.real();
    im[m] = z.imag();
  }

  friend ComplexLane operator+(const ComplexLane &a, const ComplexLane &b)
  {
    return {a.re + b.re, a.im + b.im};
  }
  friend ComplexLane operator-(const ComplexLane &a, const ComplexLane &b)
  {
    return {a.re - b.re, a.im - b.im};
  }
  friend ComplexLane operator*(const ComplexLane &a, const ComplexLane &b)
  {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend ComplexLane operator-(const ComplexLane &z) { return {-z.re, -z.im}; }
  friend ComplexLane operator*(double factor, const ComplexLane &z)
  {
    return {factor * z.re, factor * z.im};
  }
  friend ComplexLane operator*(const Lane<N> &factor, const ComplexLane &z)
  {
    return {factor * z.re, factor * z.im};
  }
  friend ComplexLane conj(const ComplexLane &z) { return {z.re, -z.im}; }
  friend ComplexLane times_i(const ComplexLane &z) { return {-z.im, z.re}; }
  friend ComplexLane over_i(const ComplexLane &z) { return {z.im, -z.re}; }
};

/// Modes are solved in blocks of neighbors in the plane (kx, ky), one per lane.
constexpr int lanes = 8;
using Lanes = Lane<lanes>;
using Modes = ComplexLane<lanes>;

}    // namespace fluid
