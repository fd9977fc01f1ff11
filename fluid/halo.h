#pragma once

#include "fluid/exchange.h"
#include "fluid/grid.h"

namespace fluid {

/// Layers of ghost cells around a rank's brick. They hold the values of the ranks that own the
/// cells, or of their periodic images. Beyond a plate there are `plate_layers` layers, filled from
/// the boundary condition; at the upper plate there is one more, because the plate itself is a
/// plane of lower faces.
/// A brick without cells has ghosts, too, where there are more than `plate_layers` layers: fewer
/// serve differences alone, which such a brick has none of.
class Halo {
 public:
  static constexpr int plate_layers = 2;

  Halo() = default;
  Halo(const Grid &grid, const Decomposition &decomposition, int width);

  /// Brick with its ghost layers: the box over which fields must be stored.
  const Box &box() const { return box_; }

  /// Ghost cells take the owners' values.
  template <std::size_t N> void fill(const std::array<View<double>, N> &fields)
  {
    exchange_.copy(fields, fields);
  }

  /// The transpose of fill: what stands in the ghost cells is added to their owners.
  template <std::size_t N> void accumulate(const std::array<View<double>, N> &fields)
  {
    exchange_.accumulate(fields, fields);
  }

  const Traffic &traffic() const { return exchange_.traffic(); }
  std::size_t bytes() const { return exchange_.bytes(); }

 private:
  Box box_;
  Exchange<double> exchange_;
};

}    // namespace fluid
