#include "contact/held_bodies.h"

#include "geometry/rounding.h"
#include "geometry/tight_vector.h"

#include <algorithm>
#include <cmath>

namespace rbc {

void HeldBodies::hold(const double *x, const NumberLists &bodies)
{
  bodies_ = &bodies;
  resize_tightly(centre_, 3 * std::size_t(count()));
  resize_tightly(radius_, count());
  for (auto *offsets : {&x_, &y_, &z_}) resize_tightly(*offsets, bodies.number.size());
  largest_radius_ = 0;
  for (int body = 0; body < count(); ++body) {
    const int begin = bodies.begin[body], end = bodies.begin[body + 1];
    PlainVector sum{0, 0, 0};
    for (int n = begin; n < end; ++n) sum = sum + at(x, bodies.number[n]);
    const PlainVector centre = (1.0 / (end - begin)) * sum;
    double largest = 0;
    for (int n = begin; n < end; ++n) {
      const PlainVector offset = at(x, bodies.number[n]) - centre;
      largest = std::max(largest, dot(offset, offset));
    }
    radius_[body] = rounded_up(std::sqrt(largest));
    const double parts = radius_[body] > 0 ? PARTS / radius_[body] : 0;    // of a length of 1
    for (int n = begin; n < end; ++n) {
      const PlainVector offset = at(x, bodies.number[n]) - centre;
      x_[n] = static_cast<Part>(std::lrint(parts * offset.x));
      y_[n] = static_cast<Part>(std::lrint(parts * offset.y));
      z_[n] = static_cast<Part>(std::lrint(parts * offset.z));
    }
    largest_radius_ = std::max(largest_radius_, double(radius_[body]));
    centre_[3 * std::size_t(body)] = centre.x;
    centre_[3 * std::size_t(body) + 1] = centre.y;
    centre_[3 * std::size_t(body) + 2] = centre.z;
  }
}

std::size_t HeldBodies::bytes() const
{
  return centre_.capacity() * sizeof(double) + radius_.capacity() * sizeof(float) +
         (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(Part);
}

}    // namespace rbc
