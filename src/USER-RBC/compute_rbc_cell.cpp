#include "compute_rbc_cell.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "membrane/cell_shape.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::Vec3;

static constexpr int NCOLS = 19;

// sums over a cell, in its own coordinates: area, volume, first and second moments, velocity,
// vertices, and the cell's origin times the vertices

enum {
  AREA,
  VOLUME,
  FIRST,
  SECOND = FIRST + 3,
  SPEED = SECOND + 6,
  COUNT = SPEED + 3,
  ORIGIN,
  NSUMS = ORIGIN + 3
};

/* ---------------------------------------------------------------------- */

ComputeRBCCell::ComputeRBCCell(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), cells(lmp, fmt::format("Compute rbc/cell {}", id)), rows_lock(lmp)
{
  if (narg > 3) error->all(FLERR, 3, "Unknown compute rbc/cell argument {}: it takes none", arg[3]);
  array_flag = 1;
  size_array_cols = NCOLS;
  size_array_rows = 0;
  size_array_rows_variable = 1;
  extarray = 0;
}

ComputeRBCCell::~ComputeRBCCell()
{
  memory->destroy(array);
}

/* ----------------------------------------------------------------------
   a row for each cell
------------------------------------------------------------------------- */

void ComputeRBCCell::init()
{
  const std::vector<tagint> before = cells.molecules();
  cells.find(groupbit);
  set_rows(before);
}

void ComputeRBCCell::cells_changed()
{
  const std::vector<tagint> before = cells.molecules();
  cells.find_again(groupbit);
  set_rows(before);
}

void ComputeRBCCell::set_rows(const std::vector<tagint> &before)
{
  if (cells.molecules() != before)
    rows_lock.check(fmt::format("Compute rbc/cell {}: cells changed ({} before, {} now)", id,
                                before.size(), cells.size()));
  const int rows = cells.size();
  if (rows != size_array_rows || !array) {
    size_array_rows = rows;
    memory->destroy(array);
    memory->create(array, std::max(rows, 1), NCOLS, "rbc/cell:array");
    for (int n = 0; n < rows; ++n) array[n][0] = 0;    // no cell yet
  }
}

/* ---------------------------------------------------------------------- */

void ComputeRBCCell::compute_array()
{
  invoked_array = update->ntimestep;
  cells.check();
  sums.assign(std::size_t(cells.size()) * NSUMS, 0.0);
  for (CellMembranes *membranes : cells.membranes()) add_sums(*membranes);
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                world);

  for (int n = 0; n < cells.size(); ++n) {
    const double *s = &sums[std::size_t(n) * NSUMS];
    rbc::VolumeMoments moments;
    moments.area = s[AREA];
    moments.volume = s[VOLUME];
    moments.first = Vec3(s + FIRST);
    moments.second << s[SECOND], s[SECOND + 3], s[SECOND + 4],    //
        s[SECOND + 3], s[SECOND + 1], s[SECOND + 5],              //
        s[SECOND + 4], s[SECOND + 5], s[SECOND + 2];
    const rbc::InertiaEllipsoid ellipsoid(moments);
    const Vec3 centre = moments.centre() + Vec3(s + ORIGIN) / s[COUNT];

    double *row = array[n];
    warn_of_jump(row, centre);
    row[0] = static_cast<double>(cells.molecules()[n]);
    row[4] = moments.area;
    row[5] = moments.volume;
    row[6] = ellipsoid.deformation();
    for (int d = 0; d < 3; ++d) {
      row[1 + d] = centre[d];
      row[7 + d] = ellipsoid.semi_axes[d];
      row[10 + d] = ellipsoid.long_axis[d];
      row[13 + d] = ellipsoid.short_axis[d];
      row[16 + d] = s[SPEED + d] / s[COUNT];
    }
  }
}

/* ----------------------------------------------------------------------
   the row is still that of the last time, the same on all ranks
------------------------------------------------------------------------- */

void ComputeRBCCell::warn_of_jump(const double *row, const Vec3 &centre)
{
  const int n = static_cast<int>((row - array[0]) / NCOLS);
  if (warned || row[0] != static_cast<double>(cells.molecules()[n])) return;
  for (int d = 0; d < 3; ++d) {
    if (!domain->periodicity[d] || !(std::abs(centre[d] - row[1 + d]) > IMGMAX * domain->prd[d]))
      continue;
    warned = true;
    const char side = "xyz"[d];
    if (comm->me == 0)
      error->warning(FLERR,
                     "Compute rbc/cell {}: the centre of the cell with molecule ID {} jumped by {} "
                     "lengths of the box in {} before step {}: image flags go from {} to {} only",
                     id, cells.molecules()[n], 2 * IMGMAX, side, update->ntimestep, -IMGMAX,
                     IMGMAX - 1);
    return;
  }
}

/* ----------------------------------------------------------------------
   a cell may lie on several ranks: each adds the triangles whose first corner it owns, and the
   vertices it owns
------------------------------------------------------------------------- */

void ComputeRBCCell::add_sums(CellMembranes &membranes)
{
  LocalCells &local = membranes.local_cells();
  const rbc::SurfaceTemplate &shape = membranes.shape();
  std::vector<Vec3> x(shape.vertex_count());
  for (const LocalCells::Cell &cell : local.cells()) {
    const int row = cells.index_of(cell.molecule);
    if (row < 0) continue;
    local.gather(cell, x);
    rbc::VolumeMoments moments;
    for (int t : cell.elements->triangles) {
      const auto &[i, j, k] = shape.triangles[t];
      if (cell.elements->owned[i]) moments.add(x[i], x[j], x[k]);
    }
    double *s = &sums[std::size_t(row) * NSUMS];
    s[AREA] += moments.area;
    s[VOLUME] += moments.volume;
    for (int d = 0; d < 3; ++d) {
      s[FIRST + d] += moments.first[d];
      s[SECOND + d] += moments.second(d, d);
    }
    s[SECOND + 3] += moments.second(0, 1);
    s[SECOND + 4] += moments.second(0, 2);
    s[SECOND + 5] += moments.second(1, 2);
    int owned = 0;
    for (int v = 0; v < shape.vertex_count(); ++v) {
      if (!cell.elements->owned[v]) continue;
      ++owned;
      for (int d = 0; d < 3; ++d) s[SPEED + d] += atom->v[cell.atom[v]][d];
    }
    s[COUNT] += owned;
    for (int d = 0; d < 3; ++d) s[ORIGIN + d] += owned * cell.origin[d];
  }
}

/* ---------------------------------------------------------------------- */

double ComputeRBCCell::memory_usage()
{
  return static_cast<double>(cells.size()) * (NSUMS + NCOLS) * sizeof(double);
}
