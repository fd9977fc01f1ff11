#pragma once

#include <cmath>
#include <limits>

namespace rbc {

/// The nearest number of single precision that is not above.
inline float rounded_down(double number)
{
  const float nearest = static_cast<float>(number);
  return nearest > number ? std::nextafter(nearest, -HUGE_VALF) : nearest;
}

/// Likewise, not below.
inline float rounded_up(double number)
{
  return -rounded_down(-number);
}

/// A number of single precision that is not above, and nearly the nearest: where there are many.
inline float not_above(double number)
{
  constexpr double part = std::numeric_limits<float>::epsilon();
  return static_cast<float>(number - part * std::abs(number) - std::numeric_limits<float>::min());
}

}    // namespace rbc
