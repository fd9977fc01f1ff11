#pragma once

#include "fluid/grid.h"
#include "fluid/kernel.h"
#include "fluid/lanes.h"
#include "fluid/marker_set.h"

#include <algorithm>
#include <cmath>

namespace fluid {

/// A marker for each lane, places in grid spacings from the origin of the grid. Lanes beyond
/// `count` repeat the last marker.
struct MarkerPlaces {
  int count;
  alignas(64) double place[3][lanes];

  MarkerPlaces(const MarkerSet &markers, int begin, const Grid &grid) :
      count(std::min(lanes, markers.count - begin))
  {
    const double inverse[3] = {1 / grid.spacing[0], 1 / grid.spacing[1], 1 / grid.spacing[2]};
    for (int n = 0; n < lanes; ++n) {
      const int marker = markers.index[begin + std::min(n, count - 1)];
      for (int d = 0; d < 3; ++d)
        place[d][n] =
            (markers.position[3 * std::ptrdiff_t(marker) + d] - grid.origin[d]) * inverse[d];
    }
  }

  /// The first marker that is no number or so far from the grid that indices would not be integers,
  /// `count` if there is none.
  int first_far() const
  {
    for (int n = 0; n < count; ++n)
      for (const auto &along : place)
        if (!(std::abs(along[n]) < 1e9)) return n;
    return count;
  }
};

/// Kernel weights of these markers in one direction, for points on faces and on centres.
template <typename Kernel> struct MarkerWeights {
  /// For one of the two.
  struct Points {
    alignas(64) int first[lanes];
    alignas(64) double weight[4][lanes];

    Points(const double *place, double shift)
    {
#pragma omp simd
      for (int n = 0; n < lanes; ++n)
        first[n] = Kernel::weights(place[n] - shift, &weight[0][n], lanes);
    }
  };

  Points face, centre;

  explicit MarkerWeights(const double *place) : face(place, 0), centre(place, 0.5) {}
};

/// In all three.
template <typename Kernel> using WeightsOfAll = std::array<MarkerWeights<Kernel>, 3>;

template <typename Kernel> WeightsOfAll<Kernel> weights_of(const MarkerPlaces &markers)
{
  const auto &x = markers.place;
  return {MarkerWeights<Kernel>(x[0]), MarkerWeights<Kernel>(x[1]), MarkerWeights<Kernel>(x[2])};
}

}    // namespace fluid
