#pragma once

#include "motion/motion.h"

#include <array>
#include <cstddef>
#include <memory>

namespace rbc {

/// Vectors of which each user makes what it needs, and which are of no use between its calls. They
/// are shared by users that work one at a time.
class WorkVectors {
 public:
  static constexpr int COUNT = 3;

  Numbers &operator[](int n) { return vectors_[n]; }

  std::size_t bytes() const
  {
    std::size_t numbers = 0;
    for (const Numbers &vector : vectors_) numbers += vector.capacity();
    return numbers * sizeof(double);
  }

 private:
  std::array<Numbers, COUNT> vectors_;
};

using SharedWorkVectors = std::shared_ptr<WorkVectors>;

}    // namespace rbc
