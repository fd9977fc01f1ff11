#pragma once

#include "fluid/lanes.h"

#include <vector>

namespace fluid {

/// Real and imaginary part along z of complex columns.
template <int N> struct Columns {
  explicit Columns(int n) : re(n, Lane<N>::Zero()), im(n, Lane<N>::Zero()) {}

  ComplexLane<N> operator[](int k) const { return {re[k], im[k]}; }
  void set(int k, const ComplexLane<N> &z)
  {
    re[k] = z.re;
    im[k] = z.im;
  }

  std::vector<Lane<N>> re, im;
};

/// What holds beyond the first and the last of a column's points, in units of the coefficient b.
enum class ColumnEnds {
  no_flux = -1,    ///< the value of the last point
  zero = 0,        ///< zero at the next point
  no_slip = 1      ///< zero midway to the next point
};

/// Columns of (a - b h^2 d^2/dz^2) x = r, solved by L D L^T.
/// `factor` takes a and b = viscosity / h^2; `solve` replaces r by x. Or row by row: `begin`, then for rising k
/// factor_row and eliminate, which needs r up to row k; then for falling k substitute, which gives x in row k.
template <int N> class HelmholtzColumns : public Columns<N> {
 public:
  using Columns<N>::re;
  using Columns<N>::im;

  explicit HelmholtzColumns(int n) : Columns<N>(n), inverse_pivot_(n), ratio_(n) {}

  void factor(const Lane<N> &a, double b, ColumnEnds ends = ColumnEnds::no_slip)
  {
    begin(a, b, ends);
    for (int k = 0; k < cells(); ++k) factor_row(k);
  }

  void solve()
  {
    for (int k = 0; k < cells(); ++k) eliminate(k);
    for (int k = cells() - 1; k >= 0; --k) substitute(k);
  }

  void begin(const Lane<N> &a, double b, ColumnEnds ends = ColumnEnds::no_slip)
  {
    a_ = a;
    b_ = b;
    end_ = static_cast<int>(ends);
  }

  void factor_row(int k)
  {
    Lane<N> pivot = a_ + b_ * (2 + end_ * ((k == 0) + (k == cells() - 1)));
    if (k > 0) pivot -= b_ * ratio_[k - 1];
    inverse_pivot_[k] = 1 / pivot;
    ratio_[k] = b_ * inverse_pivot_[k];
  }

  void eliminate(int k)
  {
    if (k == 0) return;
    re[k] += ratio_[k - 1] * re[k - 1];
    im[k] += ratio_[k - 1] * im[k - 1];
  }

  void substitute(int k)
  {
    re[k] *= inverse_pivot_[k];
    im[k] *= inverse_pivot_[k];
    if (k == cells() - 1) return;
    re[k] += ratio_[k] * re[k + 1];
    im[k] += ratio_[k] * im[k + 1];
  }

 private:
  int cells() const { return static_cast<int>(re.size()); }

  Lane<N> a_;
  double b_ = 0;
  int end_ = 0;
  std::vector<Lane<N>> inverse_pivot_, ratio_;
};

/// Columns of (q A_w + D^T A_c D) w = r on the interior faces 1 .. n-1 of n cells, w = 0 on faces 0 and n, with
/// the Helmholtz operators A of coefficients a and b = viscosity / h^2 on faces (A_w) and on centres (A_c).
/// Used row by row like HelmholtzColumns, k = 1 .. n-1.
template <int N> class VerticalColumns : public Columns<N> {
 public:
  using Columns<N>::re;
  using Columns<N>::im;

  /// Stores zeros beyond face n too.
  explicit VerticalColumns(int cells) :
      Columns<N>(cells + 2), cells_(cells), inverse_pivot_(cells, Lane<N>::Zero()),
      ratio_(cells, Lane<N>::Zero())
  {
  }

  void begin(const Lane<N> &a, const Lane<N> &q, double b)
  {
    interior_ = a + 2 * b;
    q_ = q;
    b_ = b;
    coupling_.setZero();
  }

  /// Each row couples to the next by `coupling_` and to the one after it by b, whatever the row.
  void factor_row(int k)
  {
    const auto centre = [&](int c) -> Lane<N> {
      return interior_ + ((c == 0) + (c == cells_ - 1)) * b_;
    };
    const Lane<N> pivot = q_ * interior_ + centre(k - 1) + centre(k) + 2 * b_ -
                          coupling_ * ratio_[k - 1] - b_ * b_ * inverse_pivot_[before(k)];
    inverse_pivot_[k] = 1 / pivot;
    coupling_ = -q_ * b_ - centre(k) - 2 * b_ - b_ * ratio_[k - 1];
    ratio_[k] = coupling_ * inverse_pivot_[k];
  }

  void eliminate(int k)
  {
    const Lane<N> second = b_ * inverse_pivot_[before(k)];
    re[k] = re[k] - second * re[before(k)] - ratio_[k - 1] * re[k - 1];
    im[k] = im[k] - second * im[before(k)] - ratio_[k - 1] * im[k - 1];
  }

  void substitute(int k)
  {
    re[k] = (re[k] - b_ * re[k + 2]) * inverse_pivot_[k] - ratio_[k] * re[k + 1];
    im[k] = (im[k] - b_ * im[k + 2]) * inverse_pivot_[k] - ratio_[k] * im[k + 1];
  }

 private:
  static int before(int k) { return std::max(k - 2, 0); }

  int cells_;
  Lane<N> interior_, q_, coupling_;
  double b_ = 0;
  std::vector<Lane<N>> inverse_pivot_, ratio_;
};

}    // namespace fluid
