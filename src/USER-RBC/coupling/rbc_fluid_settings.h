#ifndef LMP_RBC_FLUID_SETTINGS_H
#define LMP_RBC_FLUID_SETTINGS_H

#include "coupling/rbc_flow_forcing.h"
#include "fluid/flow.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

/// The arguments of fix rbc/fluid but for its forcing: which fluid, and on which grid.
struct FluidSettings {
  fluid::FlowEquations equations;
  std::array<int, 3> cells{};
  bool plates = false;
  fluid::PlateConditions plate_conditions;
  bool free_mean = false;          ///< asked for: the mean velocity follows from forces
  bool prescribed_mean = false;    ///< it is what was given
  std::string inside;              ///< region; empty: the whole box
};

/// An error names the argument that is wrong.
FluidSettings read_fluid_settings(LAMMPS *lmp, int narg, char **arg, FlowForcing &forcing);

}    // namespace LAMMPS_NS

#endif
