// The part of CellMembranes that warns of shapes which no red cell has.

#include "cells/rbc_cell_membranes.h"

#include "comm.h"
#include "error.h"

using namespace LAMMPS_NS;

// cells whose edges are this much longer than in the template were hardly stretched by a flow

static constexpr double TORN = 3.0;

// red cells burst where their area grows by 2 to 4 percent (Evans, Waugh and Melnik, Biophys J 16,
// 585 (1976))

static constexpr double BURST = 0.04;

/* ----------------------------------------------------------------------
   a box that was changed without its atoms tears cells that lie across its periodic sides
------------------------------------------------------------------------- */

void CellMembranes::warn_of_torn_cells()
{
  const CellImages::Stretch stretch = cells_.largest_stretch();
  if (stretch.ratio > TORN && comm->me == 0)
    error->warning(FLERR,
                   "{}: an edge of the cell with molecule ID {} is {:.3g} times as long as in its "
                   "template at the start of the run; cells across periodic sides are torn if the "
                   "box is changed without its atoms (change_box without remap, read_dump)",
                   style_, stretch.molecule, stretch.ratio);
}

/* ---------------------------------------------------------------------- */

void CellMembranes::note_areas()
{
  if (settings_.elastic.global_area == 0) return;
  for (std::size_t c = 0; c < cells_.cells().size(); ++c) {
    const double growth = sizes_[2 * c] / shape().area - 1;
    if (growth > largest_growth_.value) largest_growth_ = {growth, cells_.cells()[c].molecule};
  }
}

void CellMembranes::warn_of_large_areas()
{
  if (settings_.elastic.global_area == 0) return;
  struct {
    double growth;
    int rank;
  } mine{largest_growth_.value, comm->me}, largest;
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  if (largest.growth <= BURST) return;
  tagint molecule = largest_growth_.molecule;
  MPI_Bcast(&molecule, 1, MPI_LMP_TAGINT, largest.rank, world);
  if (comm->me == 0)
    error->warning(FLERR,
                   "{}: the area of the cell with molecule ID {} was up to {:.3g} percent larger "
                   "than in its template, and red cells burst at 2 to 4 percent; a larger "
                   "kglobal of area, now {:.3g}, makes it grow less",
                   style_, molecule, 100 * largest.growth, settings_.elastic.global_area);
}
