#ifndef LMP_RBC_FLOW_FORCING_H
#define LMP_RBC_FLOW_FORCING_H

#include "fluid/flow.h"
#include "motion/response_control.h"
#include "pointers.h"
#include "support/rbc_number_or_variable.h"

#include <array>
#include <optional>
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

  /// From now on the component `direction` (0, 1, 2) of the mean velocity inside the vessel is held
  /// at `velocity`. The control sets that component of the body force or, in a box whose mean
  /// velocity is held, of this mean velocity.
  void hold_inside(int direction, const NumberOrVariable &velocity);
  int held_direction() const { return held_direction_; }

  /// Call where the response is not known: the control finds how the mean velocity inside responds.
  /// `by_mean`: by the mean velocity of the box, otherwise by the body force. `probe`: the input
  /// (velocity or force density) that is tried for this; not 0.
  void start_control(bool by_mean, double probe);
  bool probing() const { return control_.probing(); }
  bool probes_response() const { return control_.probes_response(); }

  /// Whether the control knows the response to the input that `by_mean` tells, from this run or
  /// those before.
  bool knows_response(bool by_mean) const
  {
    return controlled_ && !probing() && by_mean_ == by_mean;
  }

  /// Tells the control which mean velocity inside the present forcing has given, unless one is held
  /// (see hold_measured); used by the next evaluate().
  void set_measured(double inside_velocity);

  /// At the start of a run: holds the velocity that the forcing had given, until the next step, so
  /// that the solve of the same forcing which comes first cannot change it. Afterwards it tells
  /// whether that solve has `given` the same velocity, within what solves are exact to.
  void hold_measured(double inside_velocity);
  bool is_holding() const { return holding_; }
  bool agrees(double given) const;

  /// Where it has: whether another velocity is wanted now than when it was measured. If so none is
  /// held any more, and the next evaluate() gives the forcing that should cause that one.
  bool follow_wanted();

  /// What is kept in restart files: 1 where the response is known, direction, 1 where the input is
  /// the mean velocity, input, response, disturbance, and `inside_velocity` unless a velocity is
  /// held.
  static constexpr int STATE = 7;
  using State = std::array<double, STATE>;
  State control_state(double inside_velocity) const;
  void restore_control(const State &state);

  bool varies() const;
  bool is_known() const { return known_; }

  /// At the start of a run: variables must exist.
  void check() const;

  /// Collective: evaluates variables, as of the step that LAMMPS is at.
  const fluid::Forcing &evaluate();

  /// Takes the forcing at the end of the last step for the start of this one, and evaluates it at
  /// the end of this one. `again`: keeps the start, because the same step is made once more with
  /// another timestep. Collective.
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
  bool controlled_ = false;     // start_control() or restore_control() was called
  bool is_measured_ = false;    // since the last change of the input
  bool holding_ = false;        // measured_ counts from the next step on
  double measured_ = 0;
  double wanted_ = 0;
  std::optional<double> wanted_then_;    // when it was measured

  void control();
};

}    // namespace LAMMPS_NS

#endif
