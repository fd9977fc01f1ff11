#ifndef LMP_RBC_MASSIVE_MARKERS_H
#define LMP_RBC_MASSIVE_MARKERS_H

#include "fluid/direct_forcing.h"
#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

class DrivenFlow;
class FixStoreAtom;
class ImmersedMarkers;

/// Markers whose mass is accelerated with the fluid (scheme direct), by a backward difference of
/// second order over the velocities in the middle of this and the last two steps, and over fewer at
/// first, from the atoms' own velocities on.
class MassiveMarkers : protected Pointers {
 public:
  explicit MassiveMarkers(LAMMPS *lmp) : Pointers(lmp) {}

  void set_limits(double tolerance, int max_solves);

  /// Columns kept for each atom: OLDER, velocity in the middle of the step before the last;
  /// INERTIAL, inertial force; MISSING, exact less computed velocity of the last step, which the
  /// next step adds so that errors below the tolerance do not accumulate; STEPS, number of steps
  /// known (0 to 2).
  static constexpr int COLUMNS = 10;
  void keep_in(FixStoreAtom *store) { store_ = store; }

  /// Takes the place of clear_force .. interpolate of the flow. Collective.
  void couple(ImmersedMarkers &markers, DrivenFlow &flow);

  /// Call at the end of a step: keeps its timestep for the difference formula of the next one.
  void accept(double dt) { last_dt_ = dt; }

  double error() const { return error_; }
  bigint unconverged() const { return unconverged_; }
  void reset_counts() { unconverged_ = 0; }

  /// Force of this rank's atoms on the fluid, in the last step.
  const std::array<double, 3> &exerted() const { return exerted_; }

  /// In restart files: the last timestep, and the time between the middles of the last two steps.
  std::array<double, 2> state() const { return {last_dt_, last_between_}; }
  void restore(const std::array<double, 2> &state)
  {
    last_dt_ = state[0];
    last_between_ = state[1];
  }

  std::size_t bytes() const;

 private:
  static constexpr int OLDER = 0, INERTIAL = 3, MISSING = 6, STEPS = 9;

  FixStoreAtom *store_ = nullptr;
  fluid::DirectForcing direct_;
  double last_dt_ = 0, last_between_ = 0;
  double error_ = 0;
  bigint unconverged_ = 0;
  std::array<double, 3> exerted_{};

  // a row for each atom here
  std::vector<double> applied_, resistance_, target_, inertial_;

  void find_target(ImmersedMarkers &markers, double between);
  void keep(const ImmersedMarkers &markers);
};

}    // namespace LAMMPS_NS

#endif
