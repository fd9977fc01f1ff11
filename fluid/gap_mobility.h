#pragma once

#include "fluid/spreading.h"

#include <vector>

namespace fluid {

/// Tells by how much sheets of markers slide too little past each other where the gap between them
/// is narrower than the cells of the grid.
///
/// Two parallel sheets a gap g apart that bear opposite tangential tractions t slide by t g /
/// viscosity: the fluid between them shears evenly. On the grid both spread t over the cells around
/// them, and what overlaps cancels. A plate that does not slip holds a sheet beside it in the same
/// way. The velocities of planes on the grid are known in closed form, and so is what is missing:
/// for sheets in the mean over all places and directions, for a plate at each distance. See
/// theory.rst.
///
/// Gaps are in fluid cells, and so is what the functions return: times t / viscosity it is the
/// velocity that is missing. They are never negative.
class GapMobility {
 public:
  explicit GapMobility(KernelKind kernel);

  /// Relative velocity of two sheets; 0 from range() on.
  double slide(double gap) const { return slide_.at(gap); }
  double range() const { return slide_.range; }

  /// Velocity of a sheet beside a plate; 0 from plate_range() on.
  double slide_at_plate(double gap) const { return plate_.at(gap); }
  double plate_range() const { return plate_.range; }

  /// Share of a double layer (see DoubleLayer) that kernels see across a gap, where they should see
  /// none: half of it without a gap, 0 from share_range() on.
  double share(double gap) const { return share_.at(gap); }
  double share_range() const { return share_.range; }

 private:
  /// A function tabulated from 0 to `range`.
  struct Table {
    double range = 0;
    std::vector<double> value;

    double at(double gap) const;
  };

  Table slide_, plate_, share_;

  template <class Kernel> void fill();
};

}    // namespace fluid
