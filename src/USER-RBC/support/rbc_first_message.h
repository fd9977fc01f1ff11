#ifndef LMP_RBC_FIRST_MESSAGE_H
#define LMP_RBC_FIRST_MESSAGE_H

#include "comm.h"
#include "lammps.h"

#include <mpi.h>
#include <string>

namespace LAMMPS_NS {

/// Collective: the message of the first rank that has one, on all ranks; empty if none has.
inline std::string first_message(LAMMPS *lmp, std::string mine)
{
  int from = mine.empty() ? lmp->comm->nprocs : lmp->comm->me;
  MPI_Allreduce(MPI_IN_PLACE, &from, 1, MPI_INT, MPI_MIN, lmp->world);
  if (from == lmp->comm->nprocs) return {};
  int length = static_cast<int>(mine.size());
  MPI_Bcast(&length, 1, MPI_INT, from, lmp->world);
  mine.resize(length);
  MPI_Bcast(mine.data(), length, MPI_CHAR, from, lmp->world);
  return mine;
}

}    // namespace LAMMPS_NS

#endif
