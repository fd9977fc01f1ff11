#pragma once

#include "geometry/plain_vector.h"

#include <vector>

namespace rbc {

/// Vectors stored by component, so that loops over them vectorise.
class VectorArray {
 public:
  explicit VectorArray(std::size_t size) : x_(size), y_(size), z_(size) {}

  PlainVector operator[](int n) const { return {x_[n], y_[n], z_[n]}; }

  void set(int n, PlainVector v)
  {
    x_[n] = v.x;
    y_[n] = v.y;
    z_[n] = v.z;
  }

 private:
  std::vector<double> x_, y_, z_;
};

}    // namespace rbc
