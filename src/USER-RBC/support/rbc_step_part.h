#ifndef LMP_RBC_STEP_PART_H
#define LMP_RBC_STEP_PART_H

#include "support/rbc_collective_stop.h"
#include "support/stopwatch.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Something that works in the steps of a fix rbc/ib: the fix lists its time, and errors found in
/// it are reported to the fix.
class StepPart {
 public:
  struct Section {
    std::string name;
    rbc::Stopwatch *stopwatch;
  };

  /// From now on in this run, errors are reported to `stop`, whose owner checks it: this ends the
  /// run or rejects the step.
  virtual void report_to(const std::shared_ptr<CollectiveStop> &stop) = 0;

  /// What the table of step cost lists. Sections of the same name are added up.
  virtual std::vector<Section> sections() = 0;

 protected:
  ~StepPart() = default;
};

}    // namespace LAMMPS_NS

#endif
