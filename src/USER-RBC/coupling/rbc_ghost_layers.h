#ifndef LMP_RBC_GHOST_LAYERS_H
#define LMP_RBC_GHOST_LAYERS_H

#include <array>
#include <string>

namespace LAMMPS_NS {

class LAMMPS;

/// What markers ask of the fluid around a subdomain.
struct MarkerReach {
  double cells_per_step = 1;    ///< that a marker may cross
  bool sheets = false;          ///< their velocities need differences of the flow
  bool layers = false;          ///< they spread double layers, and are no sheets
};

/// Layers of fluid cells that must be known around a subdomain of LAMMPS. The grid has so many
/// `cells` in each direction: an error that begins with `style` if the skin alone asks for more
/// than half of them.
int marker_layers(LAMMPS *lmp, const std::string &style, const std::array<int, 3> &cells,
                  const MarkerReach &reach);

}    // namespace LAMMPS_NS

#endif
