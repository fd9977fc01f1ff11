#pragma once

#include <cmath>

namespace rbc {

/// atan2(y, x) of finite numbers that are not both zero, to 3e-16 of its value, without a branch:
/// loops over it vectorise. Ratio of the smaller to the larger, brought to |z| <= 0.66, and there
/// the rational function of Cephes (Moshier, Methods and programs for mathematical functions,
/// 1989).
inline double arc_tangent(double y, double x)
{
  constexpr double pi = 3.14159265358979323846;
  const double rise = std::abs(y), run = std::abs(x);
  const bool steep = rise > run;
  const double small = steep ? run : rise, large = steep ? rise : run;
  const bool diagonal = small > 0.66 * large;
  const double z = (diagonal ? small - large : small) / (diagonal ? small + large : large);
  const double s = z * z;
  const double P = -6.485021904942025371773e1 +
                   s * (-1.228866684490136173410e2 +
                        s * (-7.500855792314704667340e1 +
                             s * (-1.615753718733365076637e1 + s * -8.750608600031904122785e-1)));
  const double Q =
      1.945506571482613964425e2 +
      s * (4.853903996359136964868e2 +
           s * (4.328810604912902668951e2 +
                s * (1.650270098316988542046e2 + s * (2.485846490142306297962e1 + s))));
  double angle = z + z * s * P / Q;
  angle += diagonal ? pi / 4 : 0;
  angle = steep ? pi / 2 - angle : angle;
  angle = x < 0 ? pi - angle : angle;
  return std::copysign(angle, y);
}

}    // namespace rbc
