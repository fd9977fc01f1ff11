#pragma once

#include "fluid/field.h"
#include "fluid/grid.h"

#include <functional>
#include <vector>

namespace fluid {

/// A part of the grid in which fluid appears or vanishes: the cells whose centres lie in it. The
/// rate per volume is proportional to their torsion_function(), so that it falls to zero at the
/// sides of the part, spread further by a `variance` along each direction, in cells squared, from
/// 0 to 1. It does not depend on the decomposition.
class SmoothSource {
 public:
  /// Collective.
  SmoothSource(const Grid &grid, const Decomposition &decomposition,
               const std::function<bool(const Real3 &)> &contains, double variance = 0);

  /// Of the cells whose centres lie in the part.
  double volume() const { return volume_; }

  /// They are all cells of the grid, where nothing is left in which the rate is zero.
  bool is_whole_grid() const { return whole_grid_; }

  /// Adds fluid of so much volume per time to the rates per volume on this rank's brick.
  void add(double rate, const ScalarField &supply) const;

  /// Mean over the core, where the torsion function is above half of its maximum, with this
  /// function as weight. What a kernel blurs at the sides has no part in it. Collective.
  double core_mean(const ScalarField &values, MPI_Comm comm) const;

  std::size_t bytes() const { return (mine_.capacity() + core_.capacity()) * sizeof(Cell); }

 private:
  struct Cell {
    Index3 place;
    double weight;
  };
  std::vector<Cell> mine_;    ///< with the rate per volume for a rate of 1
  std::vector<Cell> core_;    ///< with shares of the mean
  double cell_volume_, volume_ = 0;
  bool whole_grid_ = false;
};

}    // namespace fluid
