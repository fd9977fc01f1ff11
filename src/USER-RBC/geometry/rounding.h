#pragma once

#include <cmath>

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

}    // namespace rbc
