#include "coupling/rbc_ghost_layers.h"

#include "domain.h"
#include "error.h"
#include "fluid/sheet_velocity.h"
#include "lammps.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// reach of the widest kernel beyond the cell of an atom, staggering included

static constexpr int KERNEL_LAYERS = 2;

/* ----------------------------------------------------------------------
   A vertex leaves the subdomain of its rank by up to half the skin before atoms migrate, and by
   more within a step; besides, a cell belongs to the subdomain of its centre, not of all of its
   volume. cells_per_step allows for both.
------------------------------------------------------------------------- */

int LAMMPS_NS::marker_layers(LAMMPS *lmp, const std::string &style, const std::array<int, 3> &cells,
                             const MarkerReach &reach)
{
  const double skin = lmp->neighbor->skin, *const prd = lmp->domain->prd;
  double layers = 0;
  for (int d = 0; d < 3; ++d) {
    const double of_skin = 0.5 * skin / (prd[d] / cells[d]);
    if (of_skin > 0.5 * cells[d])
      lmp->error->all(FLERR,
                      "{}: a neighbor skin of {} asks for {:.4g} ghost layers, more than half of "
                      "the {} fluid cells in {}; the skin must be <= {:.6g} (neighbor command)",
                      style, skin, of_skin, cells[d], "xyz"[d], *std::min_element(prd, prd + 3));
    layers = std::max(layers, of_skin + reach.cells_per_step);
  }
  return static_cast<int>(std::ceil(layers)) + KERNEL_LAYERS +
         (reach.layers   ? 1
          : reach.sheets ? fluid::SheetVelocity::layers
                         : 0);
}
