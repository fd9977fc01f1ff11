#pragma once

#include <cmath>

namespace test {

/// A number with its derivatives along two directions a and b, first and mixed second, exact to
/// round-off (Fike & Alonso, AIAA 2011-886).
struct HyperDual {
  double value = 0, a = 0, b = 0, ab = 0;

  HyperDual() = default;
  HyperDual(double v) : value(v) {}
  HyperDual(double v, double by_a, double by_b, double by_ab) :
      value(v), a(by_a), b(by_b), ab(by_ab)
  {
  }

  /// f(x) of this number x, given f and its derivatives there.
  HyperDual mapped(double f, double slope, double second) const
  {
    return {f, slope * a, slope * b, slope * ab + second * a * b};
  }
};

inline HyperDual operator+(const HyperDual &x, const HyperDual &y)
{
  return {x.value + y.value, x.a + y.a, x.b + y.b, x.ab + y.ab};
}

inline HyperDual operator*(const HyperDual &x, const HyperDual &y)
{
  return {x.value * y.value, x.a * y.value + x.value * y.a, x.b * y.value + x.value * y.b,
          x.ab * y.value + x.a * y.b + x.b * y.a + x.value * y.ab};
}

inline HyperDual operator-(const HyperDual &x, const HyperDual &y)
{
  return x + HyperDual(-1) * y;
}

inline HyperDual operator/(const HyperDual &x, const HyperDual &y)
{
  const double over = 1 / y.value;
  return x * y.mapped(over, -over * over, 2 * over * over * over);
}

inline HyperDual sqrt(const HyperDual &x)
{
  const double root = std::sqrt(x.value);
  return x.mapped(root, 0.5 / root, -0.25 / (root * x.value));
}

inline HyperDual cos(const HyperDual &x)
{
  return x.mapped(std::cos(x.value), -std::sin(x.value), -std::cos(x.value));
}

/// x > 0.
inline HyperDual atan_of_ratio(const HyperDual &y, const HyperDual &x)
{
  const HyperDual ratio = y / x;
  const double r = ratio.value, slope = 1 / (1 + r * r);
  return ratio.mapped(std::atan(r), slope, -2 * r * slope * slope);
}

}    // namespace test
