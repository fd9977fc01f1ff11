#pragma once

#include "geometry/plain_vector.h"

#include <cmath>

namespace rbc {

/// A displacement linear in the position that is as near as one can be to those of many points, in
/// least squares. Call reset(), and place() for each of the points; then for their displacements
/// begin(), add() for each of them, and fit().
class LinearFlow {
 public:
  void reset(PlainVector origin)
  {
    origin_ = origin;
    matrix_ = products_ = {};
  }

  void place(PlainVector x) { products_.add(x - origin_, x - origin_); }

  void begin()
  {
    moved_ = {};
    sum_ = {0, 0, 0};
    squares_ = count_ = 0;
  }

  void add(PlainVector x, PlainVector displacement)
  {
    moved_.add(displacement, x - origin_);
    sum_ = sum_ + displacement;
    squares_ += dot(displacement, displacement);
    count_ += 1;
  }

  /// None where the points lie in a plane, if norm() were 0.5 or more, or if it is less than a
  /// tenth of how differently the points have moved, in squares: then it is mostly chance.
  void fit()
  {
    constexpr double flat = 1e-6;
    const auto &[a, b, c] = products_;
    const double determinant = dot(a, cross(b, c)), size = (a.x + b.y + c.z) / 3;
    matrix_ = {};
    if (!(determinant > flat * size * size * size)) return;
    const Rows inverse{1 / determinant * cross(b, c), 1 / determinant * cross(c, a),
                       1 / determinant * cross(a, b)};    // symmetric
    const auto times = [&inverse](PlainVector row) {
      return row.x * inverse.first + row.y * inverse.second + row.z * inverse.third;
    };
    matrix_ = {times(moved_.first), times(moved_.second), times(moved_.third)};
    const double part = dot(matrix_.first, moved_.first) + dot(matrix_.second, moved_.second) +
                        dot(matrix_.third, moved_.third);
    const double all = squares_ - dot(sum_, sum_) / count_;
    if (!(norm() < 0.5 && part > 0.1 * all)) matrix_ = {};
  }

  /// Of the matrix that gives displacements.
  PlainVector row(int d) const
  {
    return d == 0 ? matrix_.first : d == 1 ? matrix_.second : matrix_.third;
  }

  /// Of the matrix: a length changes by no more than this part of it.
  double norm() const
  {
    return std::sqrt(dot(matrix_.first, matrix_.first) + dot(matrix_.second, matrix_.second) +
                     dot(matrix_.third, matrix_.third));
  }

 private:
  struct Rows {
    PlainVector first{0, 0, 0}, second{0, 0, 0}, third{0, 0, 0};

    /// a times the transpose of b
    void add(PlainVector a, PlainVector b)
    {
      first = first + a.x * b;
      second = second + a.y * b;
      third = third + a.z * b;
    }
  };

  PlainVector origin_{0, 0, 0};
  Rows products_, moved_, matrix_;
  PlainVector sum_{0, 0, 0};    // of displacements
  double squares_ = 0, count_ = 0;
};

}    // namespace rbc
