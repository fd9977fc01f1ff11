#include "motion/kept_directions.h"

#include <algorithm>
#include <cmath>

namespace rbc {

namespace {

constexpr double LEAST_NEW = 1e-8;    // part of an image that is not a sum of those known

}    // namespace

void KeptDirections::find_overlaps(const Motion &motion, const Numbers &r)
{
  overlaps_.assign(count_, 0.0);
  for (int k = 0; k < count_; ++k)
    for (std::size_t i = 0; i < r.size(); ++i) overlaps_[k] += pairs_[k].image[i] * r[i];
  if (count_ > 0) motion.sum(overlaps_.data(), count_);
}

void KeptDirections::precondition(const Motion &motion, Numbers &r)
{
  find_overlaps(motion, r);
  for (int k = 0; k < count_; ++k) move_along(r, overlaps_[k], pairs_[k].change, r);
}

void KeptDirections::keep(const Motion &motion, Numbers &direction, Numbers &image)
{
  const double whole = std::sqrt(dot(motion, image, image));
  if (!(whole > 0 && std::isfinite(whole))) return;
  pairs_.resize(most_);
  if (count_ == most_) {
    std::rotate(pairs_.begin(), pairs_.begin() + 1, pairs_.end());
    --count_;
  }
  find_overlaps(motion, image);
  for (std::size_t i = 0; i < image.size(); ++i) direction[i] -= image[i];
  for (int k = 0; k < count_; ++k) {
    move_along(direction, -overlaps_[k], pairs_[k].change, direction);
    move_along(image, -overlaps_[k], pairs_[k].image, image);
  }
  const double length = std::sqrt(dot(motion, image, image));
  if (!(length > LEAST_NEW * whole)) return;
  Pair &last = pairs_[count_++];
  last.change.assign(image.size(), 0.0);
  last.image.assign(image.size(), 0.0);
  move_along(last.change, 1 / length, direction, last.change);
  move_along(last.image, 1 / length, image, last.image);
}

std::size_t KeptDirections::bytes() const
{
  std::size_t sum = overlaps_.capacity();
  for (const Pair &pair : pairs_) sum += pair.change.capacity() + pair.image.capacity();
  return sum * sizeof(double);
}

}    // namespace rbc
