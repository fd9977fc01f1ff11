#pragma once

#include "fluid/exchange.h"
#include "fluid/grid.h"

namespace fluid {

/// Layers of cells around a rank's brick that mirror the owners' values, periodic images included.
/// Between plates the layers beyond a plate belong to the boundary condition: `wall_layers` planes
/// of faces, for which the upper plate, itself a plane of lower faces, takes one layer of cells
/// more.
class Halo {
 public:
  static constexpr int wall_layers = 2;

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
