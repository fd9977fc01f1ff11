#include "motion/spectral_radius.h"

#include <cmath>

namespace rbc {

double SpectralRadius::estimate(Motion &motion, const Numbers &x, const Numbers &velocity,
                                double size, Numbers &mode)
{
  const std::size_t n = x.size();
  Numbers &changed = this->changed();
  changed = velocity;
  double radius = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const double scale = size / root_mean_square(motion, mode);
    Numbers &displaced = mode;    // until the next one is known
    for (std::size_t i = 0; i < n; ++i) displaced[i] = x[i] + scale * mode[i];
    motion.velocity(displaced, 0, changed);
    for (std::size_t i = 0; i < n; ++i) mode[i] = changed[i] - velocity[i];
    motion.complete_change(mode);
    const double before = radius;
    radius = root_mean_square(motion, mode) / size;
    const bool steady = std::abs(radius - before) <= tolerance * radius;
    if (!(radius > 0) || (steady && iteration + 1 >= min_iterations)) break;
  }
  return radius;
}

void SpectralRadius::suspect(const Motion &motion, const Numbers &start, const Numbers &end,
                             const Numbers &velocity, Numbers &mode)
{
  const std::size_t n = start.size();
  Numbers &changed = this->changed();
  changed.resize(n);
  for (std::size_t i = 0; i < n; ++i) changed[i] = end[i] - start[i];
  const double square = dot(motion, velocity, velocity);
  const double time = square > 0 ? dot(motion, changed, velocity) / square : 0;
  for (std::size_t i = 0; i < n; ++i) changed[i] -= time * velocity[i];
  const double grown = root_mean_square(motion, changed), known = root_mean_square(motion, mode);
  if (!(grown > 0 && std::isfinite(grown))) return;
  const double sign = dot(motion, mode, changed) < 0 ? -1 : 1;    // they must not cancel
  const double share = known > 0 ? sign / known : 0;
  for (std::size_t i = 0; i < n; ++i) mode[i] = share * mode[i] + changed[i] / grown;
}

}    // namespace rbc
