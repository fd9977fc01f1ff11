#ifndef LMP_RBC_STEP_PART_H
#define LMP_RBC_STEP_PART_H

#include "support/rbc_collective_stop.h"
#include "support/stopwatch.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// A style whose work belongs to the steps of a fix rbc/ib, which checks for its errors and reports
/// its time.
class StepPart {
 public:
  struct Section {
    std::string name;
    rbc::Stopwatch *stopwatch;
  };

  /// In this run errors go to `driver`. It ends the run, or takes the step again.
  virtual void report_to(const std::shared_ptr<CollectiveStop> &driver) = 0;

  /// What the table of step cost lists. Sections of the same name are added up.
  virtual std::vector<Section> sections() = 0;

 protected:
  ~StepPart() = default;
};

}    // namespace LAMMPS_NS

#endif
