#pragma once

#include "fluid/box.h"
#include "fluid/plate_condition.h"

#include <mpi.h>
#include <vector>

namespace fluid {

/// Staggered (MAC) grid: pressure in cell centres, each velocity component on the lower face of its
/// cell. Periodic in x and y; in z either periodic or closed by two plates.
struct Grid {
  Index3 cells;
  Real3 origin;
  Real3 spacing;
  bool plates = false;
  PlateConditions plate_conditions{};

  Box domain() const { return {{0, 0, 0}, cells}; }
  double cell_volume() const { return spacing[0] * spacing[1] * spacing[2]; }
  std::size_t size() const { return domain().size(); }
};

/// Which rank owns which brick of cells; the bricks cover the grid without overlap.
struct Decomposition {
  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0;
  std::vector<Box> bricks;

  Decomposition() = default;

  /// Collective: every rank names the brick it owns.
  Decomposition(MPI_Comm comm, const Box &mine) : comm(comm)
  {
    int ranks;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &ranks);
    bricks.resize(ranks);
    static_assert(sizeof(Box) == 6 * sizeof(int));
    MPI_Allgather(&mine, 6, MPI_INT, bricks.data(), 6, MPI_INT, comm);
  }

  int ranks() const { return static_cast<int>(bricks.size()); }
  const Box &mine() const { return bricks[rank]; }
};

}    // namespace fluid
