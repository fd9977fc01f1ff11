#ifndef LMP_RBC_FLOW_DRIVE_H
#define LMP_RBC_FLOW_DRIVE_H

#include "flow.h"
#include "pointers.h"
#include "rbc_number_or_variable.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

/// What drives a flow: velocities of the plates, body force and mean velocity, each component a number or a variable.
/// Variables know the ends of steps only; within a step the drive is interpolated between them.
class FlowDrive : protected Pointers {
 public:
  using Vector = std::array<NumberOrVariable, 3>;

  FlowDrive(LAMMPS *lmp, std::string style);

  Vector lower, upper, body, mean;

  bool varies() const;
  bool is_known() const { return known_; }

  /// At the start of a run: variables must exist.
  void check() const;

  /// Collective: evaluates variables, as of the step that LAMMPS is at.
  const fluid::Drive &evaluate();

  /// A step that is taken again may be shorter.
  void begin_step(bool again);

  fluid::Drive at(double fraction) const;
  const fluid::Drive &end() const { return end_; }

 private:
  std::string style_;
  bool known_ = false;
  fluid::Drive start_, end_;
};

}    // namespace LAMMPS_NS

#endif
