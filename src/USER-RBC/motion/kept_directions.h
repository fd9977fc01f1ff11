#pragma once

#include "motion/motion.h"

#include <vector>

namespace rbc {

/// The last solutions of linear equations whose operator changes slowly, and what it made of them
/// (images). They are a preconditioner for the next equation: it takes images to their solutions,
/// and leaves vectors at right angles to all images as they are.
class KeptDirections {
 public:
  explicit KeptDirections(int most) : most_(most) {}

  void forget() { count_ = 0; }

  /// One sum over ranks, none without directions.
  void precondition(const Motion &motion, Numbers &r);

  /// Keeps `direction`, whose image is `image`, unless that is a sum of those known. The oldest of
  /// `most` pairs goes. Overwrites both. Up to three sums over ranks.
  void keep(const Motion &motion, Numbers &direction, Numbers &image);

  std::size_t bytes() const;

 private:
  struct Pair {
    Numbers change;    ///< direction less image
    Numbers image;     ///< orthonormal to the others
  };

  int most_, count_ = 0;
  std::vector<Pair> pairs_;    ///< the oldest first
  Numbers overlaps_;

  void find_overlaps(const Motion &motion, const Numbers &r);
};

}    // namespace rbc
