#ifndef LMP_RBC_OUT_OF_MEMORY_H
#define LMP_RBC_OUT_OF_MEMORY_H

#include "error.h"
#include "lammps.h"

#include <mpi.h>

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace LAMMPS_NS {

/// Does work and returns whether there was memory for it.
template <typename Work> bool has_memory_for(Work &&work)
{
  try {
    std::forward<Work>(work)();
  } catch (const std::bad_alloc &) {
    return false;
  } catch (const std::length_error &) {    // of a std::vector
    return false;
  }
  return true;
}

/// Does work that may wait for other ranks. Where this rank has no memory for it, all ranks end
/// with an error as from LAMMPS's own allocations. `who` begins the message.
template <typename Work> void do_or_run_out(LAMMPS *lmp, const std::string &who, Work &&work)
{
  if (!has_memory_for(std::forward<Work>(work)))
    lmp->error->one(FLERR, "{}: this MPI task has not enough memory", who);
}

/// Collective: does work that waits for no other rank. If any rank has no memory for it, the
/// error `message` on all of them.
template <typename Work>
void do_or_run_out_together(LAMMPS *lmp, const std::string &message, Work &&work)
{
  int failed = has_memory_for(std::forward<Work>(work)) ? 0 : 1, ranks;
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_SUM, lmp->world);
  MPI_Comm_size(lmp->world, &ranks);
  if (failed)
    lmp->error->all(FLERR, "{} on {} of {} MPI task{}", message, failed, ranks,
                    ranks > 1 ? "s" : "");
}

}    // namespace LAMMPS_NS

#endif
