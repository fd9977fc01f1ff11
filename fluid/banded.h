#pragma once

#include "fluid/lanes.h"
#include "fluid/plate_condition.h"

#include <vector>

namespace fluid {

/// Real and imaginary part of complex lines along z.
template <int N> struct ComplexLines {
  explicit ComplexLines(int n) : re(n, Lane<N>::Zero()), im(n, Lane<N>::Zero()) {}

  ComplexLane<N> operator[](int k) const { return {re[k], im[k]}; }
  void set(int k, const ComplexLane<N> &z)
  {
    re[k] = z.re;
    im[k] = z.im;
  }

  std::vector<Lane<N>> re, im;
};

/// The values one point beyond the ends of a line are these factors times the values at its ends: 1
/// is a slope of zero, 0 a value of zero at the next point, -1 a value of zero midway to it.
using LineEnds = ImageFactors;
constexpr LineEnds zero_slope{1, 1}, zero_value{0, 0};

/// Sum of the image factors of those ends that row k of n rows adjoins: the first row the lower
/// one, the last row the upper one.
inline double end_factor(const LineEnds &ends, int k, int n)
{
  return (k == 0 ? ends.lower : 0) + (k == n - 1 ? ends.upper : 0);
}

/// Lines of (a - b h^2 d^2/dz^2) x = r, solved by L D L^T. `factor` takes a and b = viscosity /
/// h^2; `solve` replaces r by x. The other way is row by row: `begin`, then for rising k factor_row
/// and eliminate, which needs r up to row k; then for falling k substitute, which gives x in row k.
template <int N> class TridiagonalLines : public ComplexLines<N> {
 public:
  using ComplexLines<N>::re;
  using ComplexLines<N>::im;

  explicit TridiagonalLines(int n) : ComplexLines<N>(n), inverse_pivot_(n), ratio_(n) {}

  void factor(const Lane<N> &a, double b, const LineEnds &ends)
  {
    begin(a, b, ends);
    for (int k = 0; k < cells(); ++k) factor_row(k);
  }

  void solve()
  {
    for (int k = 0; k < cells(); ++k) eliminate(k);
    for (int k = cells() - 1; k >= 0; --k) substitute(k);
  }

  void begin(const Lane<N> &a, double b, const LineEnds &ends)
  {
    a_ = a;
    b_ = b;
    ends_ = ends;
  }

  void factor_row(int k)
  {
    Lane<N> pivot = a_ + b_ * (2 - end_factor(ends_, k, cells()));
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
  LineEnds ends_;
  std::vector<Lane<N>> inverse_pivot_, ratio_;
};

/// Lines of (q A_w + D^T A_c D) w = r on the interior faces 1 .. n-1 of n cells, w = 0 on faces 0
/// and n, with the Helmholtz operators A of coefficients a and b = viscosity / h^2 on faces (A_w)
/// and on centres (A_c), of which the latter has the given ends. Used row by row like
/// TridiagonalLines, k = 1 .. n-1.
template <int N> class PentadiagonalLines : public ComplexLines<N> {
 public:
  using ComplexLines<N>::re;
  using ComplexLines<N>::im;

  /// Stores zeros beyond face n too.
  explicit PentadiagonalLines(int cells) :
      ComplexLines<N>(cells + 2), cells_(cells), inverse_pivot_(cells, Lane<N>::Zero()),
      ratio_(cells, Lane<N>::Zero())
  {
  }

  void begin(const Lane<N> &a, const Lane<N> &q, double b, const LineEnds &ends)
  {
    interior_ = a + 2 * b;
    q_ = q;
    b_ = b;
    ends_ = ends;
    coupling_.setZero();
  }

  /// Each row couples to the next by `coupling_` and to the one after it by b, whatever the row.
  void factor_row(int k)
  {
    const auto centre = [&](int c) -> Lane<N> {
      return interior_ - end_factor(ends_, c, cells_) * b_;
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
  LineEnds ends_;
  std::vector<Lane<N>> inverse_pivot_, ratio_;
};

}    // namespace fluid
