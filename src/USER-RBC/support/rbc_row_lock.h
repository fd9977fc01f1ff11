#ifndef LMP_RBC_ROW_LOCK_H
#define LMP_RBC_ROW_LOCK_H

#include "error.h"
#include "fix.h"
#include "modify.h"
#include "pointers.h"
#include "update.h"

#include <map>
#include <string>

namespace LAMMPS_NS {

/// The fixes that average rows of a compute over steps, as fix ave/time tells it by lock() and
/// unlock(): until they are done a row must be that of the same thing.
class RowLock : protected Pointers {
 public:
  using Pointers::Pointers;

  /// Until after the step `last`, or for good if that is negative.
  void lock(const Fix *fix, bigint last) { last_step_[fix->id] = last; }
  void unlock(const Fix *fix) { last_step_.erase(fix->id); }

  /// For rows that have changed: an error, which `change` begins, if a fix averages them.
  void check(const std::string &change) const
  {
    for (const auto &[id, last] : last_step_)
      if ((last < 0 || last >= update->ntimestep) && modify->get_fix_by_id(id))
        error->all(FLERR,
                   "{} while fix {} averages them over steps: unfix it before, and define it anew",
                   change, id);
  }

 private:
  std::map<std::string, bigint> last_step_;    // by ID: a fix may be gone without a word
};

}    // namespace LAMMPS_NS

#endif
