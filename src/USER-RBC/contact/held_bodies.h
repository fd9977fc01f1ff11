#pragma once

#include "contact/number_lists.h"
#include "geometry/plain_vector.h"
#include "geometry/vector_loop.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace rbc {

/// Where the points of bodies were at one time. Each body has a centre, from which its points are
/// kept in whole parts of its radius, of two bytes each: a quarter of the memory, with coordinates
/// known to error(). That is enough for bounds: they are made wider by it.
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

  /// Of a point of a body, by its place in the lists, from the centre.
  PlainVector offset(int body, int place) const { return part(body) * parts(place); }

  /// The same as whole numbers of part(), which is a length.
  PlainVector parts(int place) const
  {
    return {double(x_[place]), double(y_[place]), double(z_[place])};
  }
  double part(int body) const { return radius_[body] * (1 / PARTS); }

  /// By how much a coordinate of it may be off: half a part, and what rounding adds.
  double error(int body) const { return 0.51 * part(body); }

  /// Bounds of where the points of a body were along a line of unit length. Errors of three
  /// coordinates add up to sqrt(3) of one; the rest is for sums in single precision.
  Bounds along(int body, PlainVector line) const
  {
    const auto lx = static_cast<float>(line.x), ly = static_cast<float>(line.y),
               lz = static_cast<float>(line.z);
    const Part *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
    const auto parts = bounds<float>(bodies_->begin[body], bodies_->begin[body + 1], [=](int n) {
      return lx * static_cast<float>(x[n]) + ly * static_cast<float>(y[n]) +
             lz * static_cast<float>(z[n]);
    });
    const double centre = dot(line, this->centre(body)), part = this->part(body),
                 off = 2 * error(body);
    return {centre + part * parts.lowest - off, centre + part * parts.highest + off};
  }

  std::size_t bytes() const;

 private:
  /// Of a coordinate. The radius has PARTS of them, so that no point of the body has more.
  using Part = std::int16_t;
  static constexpr double PARTS = std::numeric_limits<Part>::max();

  const NumberLists *bodies_ = nullptr;
  std::vector<double> centre_;
  std::vector<float> radius_;
  std::vector<Part> x_, y_, z_;
  double largest_radius_ = 0;
};

}    // namespace rbc
