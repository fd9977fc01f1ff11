#ifndef LMP_RBC_FLOW_FORCING_H
#define LMP_RBC_FLOW_FORCING_H

#include "fluid/flow.h"
#include "motion/response_control.h"
#include "pointers.h"
#include "support/rbc_number_or_variable.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

/// What drives a flow: velocities of the plates, body force and mean velocity, each component a
/// number or a variable. Variables are evaluated at the ends of steps; within a step the forcing is
/// interpolated between them.
class FlowForcing : protected Pointers {
 public:
  using Vector = std::array<NumberOrVariable, 3>;

  FlowForcing(LAMMPS *lmp, std::string style);

  Vector lower, upper, body, mean;

  /// Holds the mean velocity inside a vessel along a direction, by the body force or, where the
  /// mean velocity of the whole box is held, by that, in place of what is given for it.
  void hold_inside(int direction, const NumberOrVariable &velocity);
  int held_direction() const { return held_direction_; }

  /// At the start of a run: the response of the velocity is found anew. The probe is of an input of
  /// about that size.
  void start_control(bool by_mean, double probe);
  bool probing() const { return control_.probing(); }

  /// The velocity that the forcing has given.
  void measured(double inside_velocity);

  bool varies() const;
  bool is_known() const { return known_; }

  /// At the start of a run: variables must exist.
  void check() const;

  /// Collective: evaluates variables, as of the step that LAMMPS is at.
  const fluid::Forcing &evaluate();

  /// A step that is taken again may be shorter.
  void begin_step(bool again);

  fluid::Forcing at(double fraction) const;
  const fluid::Forcing &end() const { return end_; }

 private:
  std::string style_;
  bool known_ = false;
  fluid::Forcing start_, end_;

  int held_direction_ = -1;
  NumberOrVariable held_velocity_;
  bool by_mean_ = false;
  rbc::ResponseControl control_;
  bool is_measured_ = false;    // since the last change of the input
  double measured_ = 0;

  void control();
};

}    // namespace LAMMPS_NS

#endif
