#pragma once

#include "geometry/tight_vector.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rbc {

/// Distances up to a largest one, in a byte each: as whole parts of it, rounded down. A byte is
/// enough to leave out most of what is further than some distance, as a distance that is not larger
/// than another never has more parts.
class PackedDistances {
 public:
  using Parts = std::uint8_t;
  static constexpr int MOST = 255;

  /// Forgets all. What is beyond `largest` has as many parts as that.
  void clear(double largest)
  {
    parts_.clear();
    largest_ = largest;
  }

  void push_back(double distance) { push_back_tightly(parts_, parts(distance)); }

  Parts operator[](std::size_t n) const { return parts_[n]; }

  /// MOST of what is not a number.
  Parts parts(double distance) const
  {
    if (!(distance < largest_)) return MOST;
    return static_cast<Parts>(MOST * (std::max(distance, 0.0) / largest_));
  }

  std::size_t bytes() const { return parts_.capacity() * sizeof(Parts); }

 private:
  std::vector<Parts> parts_;
  double largest_ = 0;
};

}    // namespace rbc
