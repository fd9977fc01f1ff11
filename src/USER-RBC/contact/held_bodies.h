#pragma once

#include "contact/number_lists.h"
#include "geometry/plain_vector.h"
#include "geometry/vector_loop.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace rbc {

/// Where the points of bodies were at one time. Each body has a centre, from which its points are
/// kept in single precision: that takes half the memory and loses less than a millionth of a body.
class HeldBodies {
 public:
  /// `bodies`, which must stay, has the points of each body, some of them again, so that they are
  /// whole groups of GROUP. Positions `x` are three numbers for each point.
  void hold(const double *x, const NumberLists &bodies);

  int count() const { return bodies_ ? bodies_->count() : 0; }
  const NumberLists &bodies() const { return *bodies_; }

  /// Three numbers for each body.
  const std::vector<double> &centres() const { return centre_; }
  PlainVector centre(int body) const
  {
    const double *const c = &centre_[3 * std::size_t(body)];
    return {c[0], c[1], c[2]};
  }

  /// Of spheres around the centres with all points in them.
  double radius(int body) const { return radius_[body]; }
  double largest_radius() const { return largest_radius_; }

  /// Of a point, by its place in the lists, from the centre of its body.
  PlainVector offset(int place) const { return {x_[place], y_[place], z_[place]}; }

  /// By how much a coordinate of it may be off.
  double error(int body) const { return std::numeric_limits<float>::epsilon() * radius_[body]; }

  /// Bounds of where the points of a body were along a line of unit length.
  Bounds along(int body, PlainVector line) const
  {
    const auto lx = static_cast<float>(line.x), ly = static_cast<float>(line.y),
               lz = static_cast<float>(line.z);
    const float *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
    const auto from_centre =
        bounds<float>(bodies_->begin[body], bodies_->begin[body + 1],
                      [=](int n) { return lx * x[n] + ly * y[n] + lz * z[n]; });
    const double centre = dot(line, this->centre(body)), off = 4 * error(body);
    return {centre + from_centre.lowest - off, centre + from_centre.highest + off};
  }

  std::size_t bytes() const;

 private:
  const NumberLists *bodies_ = nullptr;
  std::vector<double> centre_;
  std::vector<float> radius_, x_, y_, z_;
  double largest_radius_ = 0;
};

}    // namespace rbc
