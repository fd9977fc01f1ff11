#ifndef LMP_RBC_COLLECTIVE_STOP_H
#define LMP_RBC_COLLECTIVE_STOP_H

#include "comm.h"
#include "error.h"
#include "pointers.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace LAMMPS_NS {

/// Ends a run for what one task found. All tasks leave together: an abort by one (error->one) would
/// cut off what the others have not yet written of log and thermodynamic output.
class CollectiveStop : protected Pointers {
 public:
  using Pointers::Pointers;

  /// While a step is tried that can be taken again, check() throws this on all ranks instead of
  /// ending the run.
  struct FailedTrial : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  bool trying = false;

  /// The first message of a task counts.
  void report(const std::string &message)
  {
    if (message_.empty()) message_ = message;
  }

  /// Collective: an error if a task has reported one.
  void check()
  {
    int from = message_.empty() ? comm->nprocs : comm->me;
    if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, &from, 1, MPI_INT, MPI_MIN, world);
    if (from == comm->nprocs) return;
    int length = static_cast<int>(message_.size());
    MPI_Bcast(&length, 1, MPI_INT, from, world);
    message_.resize(length);
    MPI_Bcast(message_.data(), length, MPI_CHAR, from, world);
    const std::string text = std::exchange(message_, {});
    if (trying) throw FailedTrial(text);
    error->all(FLERR, "{}", text);
  }

 private:
  std::string message_;
};

}    // namespace LAMMPS_NS

#endif
