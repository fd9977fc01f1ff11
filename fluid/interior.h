#pragma once

#include "fluid/flow.h"

#include <functional>
#include <vector>

namespace fluid {

/// A part of the fluid, that inside a vessel for example: the share of each cell that belongs to
/// it.
class Interior {
 public:
  /// Collective. Cells with corners on both sides are sampled.
  Interior(const Grid &grid, const Decomposition &decomposition,
           const std::function<bool(const Real3 &)> &contains);

  double volume() const { return volume_; }

  /// Adds the force density `density` times the share of each cell to the flow's force, half to
  /// each of the two faces of the cell; call before accumulate_ghosts.
  void add_force(const Flow &flow, const Real3 &density) const;

  /// Collective; fills the ghosts of the velocity where they are not.
  Real3 mean_velocity(Flow &flow) const;

 private:
  std::vector<float> share_;    ///< of this rank's cells
  double volume_ = 0;
};

}    // namespace fluid
