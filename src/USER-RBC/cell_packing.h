#pragma once

#include "surface_template.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace rbc {

/// Vertices placed so far in a box, periodic where said, in bins of the least distance wanted between cells.
class CellPacking {
 public:
  CellPacking(const Vec3 &lo, const Vec3 &length, const std::array<bool, 3> &periodic, double gap) :
      lo_(lo), length_(length), periodic_(periodic), gap_(gap)
  {
    for (int d = 0; d < 3; ++d) bins_[d] = std::max(1, static_cast<int>(length[d] / gap));
  }

  /// No vertex lies within the gap of one placed before, nor within half of it of a side that is not periodic.
  bool fits(const std::vector<Vec3> &vertices) const
  {
    for (const Vec3 &vertex : vertices)
      if (!clear_of_sides(vertex) || !clear_of_others(vertex)) return false;
    return true;
  }

  void add(const std::vector<Vec3> &vertices)
  {
    for (const Vec3 &vertex : vertices) placed_[key(bin(vertex))].push_back(vertex);
  }

 private:
  using Bin = std::array<int, 3>;

  Bin bin(const Vec3 &x) const
  {
    Bin bin;
    for (int d = 0; d < 3; ++d) {
      const int b = static_cast<int>(std::floor((x[d] - lo_[d]) / length_[d] * bins_[d]));
      bin[d] = periodic_[d] ? (b % bins_[d] + bins_[d]) % bins_[d]
                            : std::min(std::max(b, 0), bins_[d] - 1);
    }
    return bin;
  }

  long key(const Bin &bin) const
  {
    return bin[0] + long(bins_[0]) * (bin[1] + long(bins_[1]) * bin[2]);
  }

  bool clear_of_sides(const Vec3 &x) const
  {
    for (int d = 0; d < 3; ++d)
      if (!periodic_[d] && (x[d] < lo_[d] + gap_ / 2 || x[d] > lo_[d] + length_[d] - gap_ / 2))
        return false;
    return true;
  }

  bool clear_of_others(const Vec3 &x) const
  {
    const Bin home = bin(x);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          Bin near{home[0] + dx, home[1] + dy, home[2] + dz};
          bool outside = false;
          for (int d = 0; d < 3; ++d) {
            if (periodic_[d])
              near[d] = (near[d] + bins_[d]) % bins_[d];
            else
              outside = outside || near[d] < 0 || near[d] >= bins_[d];
          }
          if (outside) continue;
          const auto found = placed_.find(key(near));
          if (found == placed_.end()) continue;
          for (const Vec3 &other : found->second)
            if (nearest(x - other).squaredNorm() < gap_ * gap_) return false;
        }
    return true;
  }

  Vec3 nearest(Vec3 separation) const
  {
    for (int d = 0; d < 3; ++d)
      if (periodic_[d]) separation[d] -= length_[d] * std::round(separation[d] / length_[d]);
    return separation;
  }

  Vec3 lo_, length_;
  std::array<bool, 3> periodic_;
  double gap_;
  Bin bins_;
  std::unordered_map<long, std::vector<Vec3>> placed_;
};

}    // namespace rbc
