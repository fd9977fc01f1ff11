#include "spectral_radius.h"

#include <cmath>

namespace rbc {

double SpectralRadius::estimate(Motion &motion, const Numbers &x, const Numbers &velocity,
                                double size, Numbers &mode)
{
  const std::size_t n = x.size();
  displaced_.resize(n);
  changed_ = velocity;
  double radius = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const double scale = size / root_mean_square(motion, mode);
    for (std::size_t i = 0; i < n; ++i) displaced_[i] = x[i] + scale * mode[i];
    motion.velocity(displaced_, 0, changed_);
    for (std::size_t i = 0; i < n; ++i) mode[i] = changed_[i] - velocity[i];
    const double before = radius;
    radius = root_mean_square(motion, mode) / size;
    const bool steady = std::abs(radius - before) <= tolerance * radius;
    if (!(radius > 0) || (steady && iteration + 1 >= min_iterations)) break;
  }
  return radius;
}

}    // namespace rbc
