#pragma once

#include "geometry/packing_box.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace rbc {

/// Finds points near a place, with all periodic images, by bins.
class PointBins {
 public:
  /// Bins about as wide as the distances looked for.
  PointBins(const PackingBox &box, double width) : box_(box)
  {
    for (int d = 0; d < 3; ++d)
      bins_[d] = static_cast<int>(std::clamp(box.length[d] / width, 1.0, 1e6));
  }

  /// Points are numbered from 0 in the order in which they are added.
  void add(const Vec3 &x)
  {
    const Bin at = bin(x);
    Vec3 image = Vec3::Zero();
    members_[key(inside(at, image))].push_back({count_++, x - image});
  }

  /// Calls f(number, image of the point) for all images nearer than `distance` to x.
  template <typename Function> void visit(const Vec3 &x, double distance, const Function &f) const
  {
    const Bin home = bin(x);
    Bin lo, hi;
    for (int d = 0; d < 3; ++d) {
      const int wide = static_cast<int>(std::ceil(distance / box_.length[d] * bins_[d]));
      lo[d] = home[d] - wide;
      hi[d] = home[d] + wide;
      if (box_.periodic[d]) continue;
      lo[d] = std::max(lo[d], 0);
      hi[d] = std::min(hi[d], bins_[d] - 1);
    }
    for (int k = lo[2]; k <= hi[2]; ++k)
      for (int j = lo[1]; j <= hi[1]; ++j)
        for (int i = lo[0]; i <= hi[0]; ++i) {
          Vec3 image = Vec3::Zero();
          const auto found = members_.find(key(inside({i, j, k}, image)));
          if (found == members_.end()) continue;
          for (const auto &[number, place] : found->second)
            if ((place + image - x).squaredNorm() < distance * distance) f(number, place + image);
        }
  }

 private:
  using Bin = std::array<int, 3>;

  PackingBox box_;
  Bin bins_;
  int count_ = 0;
  std::unordered_map<long, std::vector<std::pair<int, Vec3>>> members_;

  /// Outside a wall, the last one before it. Places too far off for a number of bins share one.
  Bin bin(const Vec3 &x) const
  {
    Bin bin;
    for (int d = 0; d < 3; ++d) {
      const double at = std::floor((x[d] - box_.lo[d]) / box_.length[d] * bins_[d]);
      bin[d] = static_cast<int>(std::clamp(at, -1e9, 1e9));
      if (!box_.periodic[d]) bin[d] = std::clamp(bin[d], 0, bins_[d] - 1);
    }
    return bin;
  }

  /// The bin of the box of which this one is an image, and the shift from there.
  Bin inside(Bin bin, Vec3 &image) const
  {
    for (int d = 0; d < 3; ++d) {
      const int boxes = static_cast<int>(std::floor(double(bin[d]) / bins_[d]));
      bin[d] -= boxes * bins_[d];
      image[d] = boxes * box_.length[d];
    }
    return bin;
  }

  long key(const Bin &bin) const
  {
    return bin[0] + long(bins_[0]) * (bin[1] + long(bins_[1]) * bin[2]);
  }
};

}    // namespace rbc
