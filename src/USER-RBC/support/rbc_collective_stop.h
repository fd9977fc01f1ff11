#ifndef LMP_RBC_COLLECTIVE_STOP_H
#define LMP_RBC_COLLECTIVE_STOP_H

#include "comm.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "pointers.h"
#include "support/rbc_remedies.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// Ends a run for what one task found. All tasks leave together: an abort by one (error->one) would
/// cut off what the others have not yet written of log and thermodynamic output.
class CollectiveStop : protected Pointers {
 public:
  using Pointers::Pointers;

  /// While a step is tried that can be taken again, check() throws this on all ranks instead of
  /// ending the run.
  struct FailedTrial : std::runtime_error {
    Flaw flaw;
    FailedTrial(const std::string &text, Flaw seen) : std::runtime_error(text), flaw(seen) {}
  };
  bool trying = false;

  /// Cells are whole when it ends a run, so that a picture of them can be written.
  bool shows_failure = false;

  /// The first message of a task counts.
  void report(const std::string &message, Flaw flaw = Flaw::other)
  {
    if (!message_.empty()) return;
    message_ = message;
    flaw_ = flaw;
  }

  /// Collective: an error if a task has reported one.
  void check()
  {
    int from = message_.empty() ? comm->nprocs : comm->me;
    if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, &from, 1, MPI_INT, MPI_MIN, world);
    if (from == comm->nprocs) return;
    int head[2] = {static_cast<int>(message_.size()), static_cast<int>(flaw_)};
    MPI_Bcast(head, 2, MPI_INT, from, world);
    message_.resize(head[0]);
    MPI_Bcast(message_.data(), head[0], MPI_CHAR, from, world);
    const std::string text = std::exchange(message_, {});
    const auto flaw = static_cast<Flaw>(head[1]);
    if (trying) throw FailedTrial(text, flaw);
    end_run(text, {flaw});
  }

  /// Collective: ends the run with a message, to which the fixes add what may help against the
  /// flaws seen.
  [[noreturn]] void end_run(std::string text, const std::vector<Flaw> &seen)
  {
    std::vector<RunEnd *> ends;
    const std::vector<Fix *> fixes = modify->get_fix_list();    // which others ask for, too
    for (Fix *fix : fixes) {
      const auto end = dynamic_cast<RunEnd *>(fix);
      if (!end) continue;
      text += end->remedies_for(seen);
      ends.push_back(end);
    }
    if (shows_failure)
      for (RunEnd *end : ends) end->write_failure(text);
    error->all(FLERR, "{}", text);
  }

 private:
  std::string message_;
  Flaw flaw_ = Flaw::other;
};

}    // namespace LAMMPS_NS

#endif
