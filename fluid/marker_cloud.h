#pragma once

#include "fluid/flow.h"

#include <algorithm>
#include <cmath>

namespace fluid {

/// The markers of all ranks. Distances are those of the nearest images.
struct MarkerCloud {
  std::vector<Real3> position;
  std::vector<int> body;
  Real3 origin, period;
  bool periodic[3];

  int count() const { return static_cast<int>(position.size()); }

  Real3 apart(int from, int to) const
  {
    Real3 r;
    for (int d = 0; d < 3; ++d) {
      r[d] = position[to][d] - position[from][d];
      if (periodic[d]) r[d] -= period[d] * std::round(r[d] / period[d]);
    }
    return r;
  }
  double distance2(int a, int b) const
  {
    const Real3 r = apart(a, b);
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  }
};

/// Markers in bins of at least a given size.
class MarkerBins {
 public:
  MarkerBins(const MarkerCloud &cloud, double size) : cloud_(cloud)
  {
    for (int d = 0; d < 3; ++d) {
      n_[d] = std::max(1, static_cast<int>(std::min(cloud.period[d] / size, 200.0)));
      scale_[d] = n_[d] / cloud.period[d];
    }
    heads_.assign(std::size_t(n_[0]) * n_[1] * n_[2], -1);
    next_.assign(cloud.position.size(), -1);
  }

  void add(int marker)
  {
    const auto bin = bin_of(marker);
    int &head = heads_[(std::size_t(bin[2]) * n_[1] + bin[1]) * n_[0] + bin[0]];
    next_[marker] = head;
    head = marker;
  }

  /// Visits markers near another until visit(marker) is false; returns whether it never was.
  template <typename Visit> bool near(int marker, Visit visit) const
  {
    const auto bin = bin_of(marker);
    std::array<int, 3> lo, hi;
    for (int d = 0; d < 3; ++d) {
      lo[d] = n_[d] < 3 ? 0 : bin[d] - 1;
      hi[d] = n_[d] < 3 ? n_[d] - 1 : bin[d] + 1;
    }
    for (int k = lo[2]; k <= hi[2]; ++k)
      for (int j = lo[1]; j <= hi[1]; ++j)
        for (int i = lo[0]; i <= hi[0]; ++i) {
          const std::array<int, 3> at{wrap(i, 0), wrap(j, 1), wrap(k, 2)};
          int other = heads_[(std::size_t(at[2]) * n_[1] + at[1]) * n_[0] + at[0]];
          for (; other >= 0; other = next_[other])
            if (!visit(other)) return false;
        }
    return true;
  }

 private:
  const MarkerCloud &cloud_;
  std::array<int, 3> n_;
  Real3 scale_;
  std::vector<int> heads_, next_;

  int wrap(int i, int d) const { return (i % n_[d] + n_[d]) % n_[d]; }
  std::array<int, 3> bin_of(int marker) const
  {
    std::array<int, 3> bin;
    for (int d = 0; d < 3; ++d)
      bin[d] = wrap(
          static_cast<int>(std::floor((cloud_.position[marker][d] - cloud_.origin[d]) * scale_[d])),
          d);
    return bin;
  }
};

}    // namespace fluid
