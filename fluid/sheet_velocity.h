#pragma once

#include "fluid/forcing.h"
#include "fluid/grid.h"
#include "fluid/spreading.h"

#include <vector>

namespace fluid {

/// Velocity with which sheets of markers move: u - C_2 D u + C_4 D D u, with D the sum of the
/// second differences over the directions, see sheet_correction().
class SheetVelocity {
 public:
  /// Layers of cells around a kernel that the differences need.
  static constexpr int layers = 2;

  SheetVelocity() = default;

  /// Velocities over `box` are stored in `lent` memory.
  SheetVelocity(const Box &box, double *lent) : result_(box, lent) {}

  /// The velocity field that kernels interpolate, in all of `velocity`'s box but the outermost
  /// layers; its ghosts must be filled. Valid until the next call, or until the memory that was
  /// lent is used otherwise. Not collective.
  const VectorField &of(const VectorField &velocity, KernelKind kernel, const Grid &grid,
                        const PlateVelocities &plates);

  std::size_t bytes() const
  {
    return result_.bytes() + 3 * curvature_[0].capacity() * sizeof(double);
  }

 private:
  VectorField result_;
  std::vector<double> curvature_[3];    ///< D u of three planes of a component, by k modulo 3

  double *curvature(int k) { return curvature_[(k % 3 + 3) % 3].data(); }
  void find_curvature(const View<double> &u, int component, int k, const Box &once,
                      const Grid &grid);
};

/// What is left of a box when `layers` are taken off on all sides but beyond plates, where the
/// mirror image gives the velocity.
Box without_layers(Box box, const Grid &grid, int layers);

}    // namespace fluid
