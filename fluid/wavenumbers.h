#pragma once

#include <cmath>
#include <complex>
#include <vector>

namespace fluid {

/// Symbols of the staggered difference over one spacing h for the modes first <= m < last of n
/// points: (exp(i k h) - 1) / h = i kappa exp(i k h / 2) with the modified wavenumber kappa = 2
/// sin(k h / 2) / h.
struct Wavenumbers {
  std::vector<double> kappa;
  std::vector<std::complex<double>> half_shift;    ///< exp(i k h / 2), to the next centre

  Wavenumbers(int n, double h, int first, int last)
  {
    constexpr double pi = 3.14159265358979323846;
    for (int m = first; m < last; ++m) {
      const double half_kh = pi * (2 * m <= n ? m : m - n) / n;
      kappa.push_back(2 * std::sin(half_kh) / h);
      half_shift.push_back(std::polar(1.0, half_kh));
    }
  }
};

}    // namespace fluid
