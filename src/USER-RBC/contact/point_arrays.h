#pragma once

#include "geometry/plain_vector.h"
#include "geometry/vector_loop.h"

#include <cstddef>
#include <vector>

namespace rbc {

/// Points, or displacements, as an array of each coordinate: loops over them are vectorised.
struct PointArrays {
  std::vector<double> x, y, z;

  PlainVector operator[](int n) const { return {x[n], y[n], z[n]}; }

  /// Those of the `all` that have these numbers; three coordinates of each follow each other.
  void take(const double *all, const std::vector<int> &numbers)
  {
    resize(numbers.size());
    for_each(static_cast<int>(numbers.size()), [&](int n) {
      const double *const point = all + 3 * std::ptrdiff_t(numbers[n]);
      x[n] = point[0];
      y[n] = point[1];
      z[n] = point[2];
    });
  }

  void resize(std::size_t count)
  {
    for (auto *numbers : {&x, &y, &z}) numbers->resize(count);
  }

  std::size_t bytes() const { return 3 * x.capacity() * sizeof(double); }
};

}    // namespace rbc
