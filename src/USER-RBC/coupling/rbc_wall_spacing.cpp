#include "coupling/rbc_wall_spacing.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "geometry/surface_spacing.h"

#include <vector>

using namespace LAMMPS_NS;
using rbc::SurfaceSpacing;
using rbc::Vec3;

namespace {

// In spacings of the grid. The flow rate in a tube is off by 0.4 % where points are 2.25 apart, the
// drag of a sphere of radius 7.4 by 1.2 % where atoms of a sheet are 1.75 apart.
constexpr double MOST_OF_POINTS = 2.25, MOST_OF_SHEETS = 1.75, REACH = 6;
constexpr double SHARE = 0.1;    // of the atoms that may be further apart: along edges, by chance

using Offer = void (SurfaceSpacing::*)(const Vec3 &);

/// Points that have come from one rank; as Comm::ring calls it.
// NOLINTNEXTLINE(readability-non-const-parameter)
template <Offer offer> void take(int count, char *buffer, void *spacing)
{
  const auto *const points = reinterpret_cast<const Vec3 *>(buffer);
  for (int n = 0; n < count; ++n) (static_cast<SurfaceSpacing *>(spacing)->*offer)(points[n]);
}

}    // namespace

/* ----------------------------------------------------------------------
   Positions are counted in spacings of the grid, which may differ between directions.
------------------------------------------------------------------------- */

void LAMMPS_NS::warn_of_coarse_wall(LAMMPS *lmp, const WallGroup &wall,
                                    const std::array<int, 3> &cells)
{
  const Atom &atom = *lmp->atom;
  const Domain &domain = *lmp->domain;
  rbc::PackingBox box;
  for (int d = 0; d < 3; ++d) {
    box.lo[d] = 0;
    box.length[d] = cells[d];
    box.periodic[d] = domain.periodicity[d] != 0;
  }
  std::vector<Vec3> points;
  for (int i = 0; i < atom.nlocal; ++i) {
    if (!(atom.mask[i] & wall.groupbit())) continue;
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = (atom.x[i][d] - domain.boxlo[d]) / domain.prd[d] * cells[d];
    points.push_back(x);
  }

  SurfaceSpacing spacing(box, points, REACH);
  static_assert(sizeof(Vec3) == 3 * sizeof(double), "points are sent as bytes");
  const int count = static_cast<int>(points.size());
  for (const auto pass :
       {take<&SurfaceSpacing::offer_neighbor>, take<&SurfaceSpacing::offer_across>})
    lmp->comm->ring(count, sizeof(Vec3), points.data(), 1, pass, nullptr, &spacing);

  const bool sheets = wall.settings().kind == fluid::MarkerKind::sheets;
  const double most = sheets ? MOST_OF_SHEETS : MOST_OF_POINTS;
  double sums[4] = {static_cast<double>(count), 0, 0, 0};    // atoms, on surfaces, far apart; mean
  for (int n = 0; n < count; ++n) {
    if (spacing.spacing(n) < 0) continue;
    sums[1] += 1;
    sums[2] += spacing.spacing(n) > most;
    sums[3] += spacing.spacing(n);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, lmp->world);
  if (lmp->comm->me != 0 || sums[0] == 1 || sums[2] <= SHARE * sums[1]) return;
  lmp->error->warning(
      FLERR,
      "{}: {:.0f} of {:.0f} atoms are more than {} spacings of the fluid's grid "
      "from those beside them ({:.3g} in the mean of all). Fluid passes between them, "
      "and the slip does not show it: put them 1 to 1.5 spacings apart",
      wall.style(), sums[2], sums[0], most, sums[3] / sums[1]);
}
