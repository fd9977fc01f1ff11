#pragma once

#include "lanes.h"

#include <vector>

namespace fluid {

/// Real and imaginary part along z of complex columns.
template <int N> struct Columns {
  explicit Columns(int n) : re(n), im(n) {}

  std::vector<Lane<N>> re, im;
};

/// Columns of (a - b h^2 d^2/dz^2) x = r with r, x in cell centres and x = 0 on both plates, solved by L D L^T.
/// `factor` takes a and b = viscosity / h^2; `solve` replaces r by x.
template <int N> class HelmholtzColumns : public Columns<N> {
 public:
  using Columns<N>::re;
  using Columns<N>::im;

  explicit HelmholtzColumns(int n) : Columns<N>(n), inverse_pivot_(n), ratio_(n) {}

  void factor(const Lane<N> &a, double b)
  {
    const int n = static_cast<int>(re.size());
    for (int k = 0; k < n; ++k) {
      Lane<N> pivot = a + b * (2 + (k == 0) + (k == n - 1));
      if (k > 0) pivot -= b * ratio_[k - 1];
      inverse_pivot_[k] = 1 / pivot;
      ratio_[k] = b * inverse_pivot_[k];
    }
  }

  void solve()
  {
    const int n = static_cast<int>(re.size());
    for (int k = 1; k < n; ++k) {
      re[k] += ratio_[k - 1] * re[k - 1];
      im[k] += ratio_[k - 1] * im[k - 1];
    }
    re[n - 1] *= inverse_pivot_[n - 1];
    im[n - 1] *= inverse_pivot_[n - 1];
    for (int k = n - 2; k >= 0; --k) {
      re[k] = re[k] * inverse_pivot_[k] + ratio_[k] * re[k + 1];
      im[k] = im[k] * inverse_pivot_[k] + ratio_[k] * im[k + 1];
    }
  }

 private:
  std::vector<Lane<N>> inverse_pivot_, ratio_;
};

/// Columns of (q A_w + D^T A_c D) w = r on the interior faces 1 .. n-1 of n cells, w = 0 on faces 0 and n, with
/// the Helmholtz operators A of coefficients a and b = viscosity / h^2 on faces (A_w) and on centres (A_c).
/// Pentadiagonal, symmetric positive definite; L D L^T. `solve` replaces r by w.
template <int N> class VerticalColumns : public Columns<N> {
 public:
  using Columns<N>::re;
  using Columns<N>::im;

  /// `faces` = n + 1
  explicit VerticalColumns(int faces) :
      Columns<N>(faces), inverse_pivot_(faces), first_(faces), second_(faces)
  {
  }

  void factor(const Lane<N> &a, const Lane<N> &q, double b)
  {
    const int n = cells();
    const Lane<N> interior = a + 2 * b;
    const auto centre = [&](int k) -> Lane<N> { return interior + ((k == 0) + (k == n - 1)) * b; };
    Lane<N> previous_first = Lane<N>::Zero(), previous_second = Lane<N>::Zero(),
            older_second = Lane<N>::Zero();
    Lane<N> previous_pivot = Lane<N>::Zero(), older_pivot = Lane<N>::Zero();
    for (int k = 1; k < n; ++k) {
      const Lane<N> diagonal = q * interior + centre(k - 1) + centre(k) + 2 * b;
      const Lane<N> next = -q * b - centre(k) - 2 * b;
      const Lane<N> pivot =
          diagonal - previous_pivot * previous_first.square() - older_pivot * older_second.square();
      inverse_pivot_[k] = 1 / pivot;
      first_[k] = (next - previous_pivot * previous_first * previous_second) * inverse_pivot_[k];
      second_[k] = b * inverse_pivot_[k];
      older_pivot = previous_pivot;
      older_second = previous_second;
      previous_pivot = pivot;
      previous_first = first_[k];
      previous_second = second_[k];
    }
  }

  void solve()
  {
    const int n = cells();
    re[0].setZero();
    im[0].setZero();
    re[n].setZero();
    im[n].setZero();
    for (int k = 2; k < n; ++k) {
      re[k] -= first_[k - 1] * re[k - 1];
      im[k] -= first_[k - 1] * im[k - 1];
      if (k == 2) continue;
      re[k] -= second_[k - 2] * re[k - 2];
      im[k] -= second_[k - 2] * im[k - 2];
    }
    for (int k = n - 1; k >= 1; --k) {
      re[k] = re[k] * inverse_pivot_[k] - first_[k] * re[k + 1];
      im[k] = im[k] * inverse_pivot_[k] - first_[k] * im[k + 1];
      if (k == n - 1) continue;
      re[k] -= second_[k] * re[k + 2];
      im[k] -= second_[k] * im[k + 2];
    }
  }

 private:
  int cells() const { return static_cast<int>(re.size()) - 1; }

  std::vector<Lane<N>> inverse_pivot_, first_, second_;
};

}    // namespace fluid
