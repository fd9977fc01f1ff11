#ifndef LMP_RBC_STEP_COST_H
#define LMP_RBC_STEP_COST_H

#include "lmptype.h"
#include "pointers.h"
#include "support/rbc_step_part.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Where the time of steps goes: a line for each section of all parts, summed over ranks.
class StepCost : protected Pointers {
 public:
  using Pointers::Pointers;

  /// From here on; sections are listed in the order of the parts.
  void start(const std::vector<StepPart *> &parts);

  /// Collective: lines of time per solve, per vertex and per fluid cell.
  std::string table(bigint solves, bigint vertices, double cells) const;

 private:
  std::vector<StepPart::Section> sections_;
};

}    // namespace LAMMPS_NS

#endif
