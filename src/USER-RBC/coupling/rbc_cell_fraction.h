#ifndef LMP_RBC_CELL_FRACTION_H
#define LMP_RBC_CELL_FRACTION_H

#include "fluid/flow.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

/// The share of each cell of the grid that lies inside cells of all fixes rbc/membrane: the local
/// hematocrit.
class CellFraction : protected Pointers {
 public:
  using Pointers::Pointers;

  /// For the present positions of the atoms, on the brick of the flow. Costs a solve. There must be
  /// membranes, and a fix rbc/ib whose markers they are. Collective.
  const fluid::ScalarField &find(fluid::Flow &flow);

  std::size_t bytes() const;

 private:
  fluid::ScalarField share_;
  std::vector<int> vertices_;
  std::vector<double> area_;    ///< times normal, of each atom here

  double total_volume();
};

}    // namespace LAMMPS_NS

#endif
