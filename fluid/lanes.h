#pragma once

#include <Eigen/Dense>
#include <complex>

namespace fluid {

/// The same quantity of several independent modes, one per SIMD lane.
template <int N> using Lane = Eigen::Array<double, N, 1>;

template <int N> struct ComplexLane {
  Lane<N> re, im;

  /// The first `count` lanes; the others are zero.
  static ComplexLane load(const std::complex<double> *from, int count = N)
  {
    ComplexLane z;
    if (count == N) {
      for (int m = 0; m < N; ++m) {
        z.re[m] = from[m].real();
        z.im[m] = from[m].imag();
      }
      return z;
    }
    z = zero();
    for (int m = 0; m < count; ++m) z.set(m, from[m]);
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

  static ComplexLane zero() { return {Lane<N>::Zero(), Lane<N>::Zero()}; }

  friend ComplexLane operator*(const ComplexLane &z, const Lane<N> &factor)
  {
    return {z.re * factor, z.im * factor};
  }

  /// a + b z and a - conj(b) z, where b may be the same for all lanes.
  template <typename B>
  friend ComplexLane plus_product(const ComplexLane &a, const B &b, const ComplexLane &z)
  {
    return {a.re + b.re * z.re - b.im * z.im, a.im + b.re * z.im + b.im * z.re};
  }
  template <typename B>
  friend ComplexLane minus_conjugate_product(const ComplexLane &a, const B &b, const ComplexLane &z)
  {
    return {a.re - b.re * z.re - b.im * z.im, a.im - b.re * z.im + b.im * z.re};
  }
};

}    // namespace fluid
