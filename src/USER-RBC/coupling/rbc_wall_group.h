#ifndef LMP_RBC_WALL_GROUP_H
#define LMP_RBC_WALL_GROUP_H

#include "fluid/spreading.h"
#include "pointers.h"
#include "support/rbc_number_or_variable.h"

#include <array>
#include <string>
#include <utility>

namespace LAMMPS_NS {

/// The atoms of a fix rbc/wall, which move as one with a prescribed velocity, and the forces on
/// them.
class WallGroup : protected Pointers {
 public:
  struct Settings {
    std::array<NumberOrVariable, 3> velocity;
    fluid::KernelKind kernel = fluid::default_kernel;
    fluid::MarkerKind kind = fluid::MarkerKind::points;
    double tolerance = 1.0e-3;    ///< largest slip, see fluid::RigidSurface
    int max_solves = 100;         ///< of an evaluation
  };

  WallGroup(LAMMPS *lmp, std::string style, int groupbit, const Settings &settings);
  ~WallGroup() override;

  const std::string &style() const { return style_; }
  const Settings &settings() const { return settings_; }
  int groupbit() const { return groupbit_; }

  /// At the start of a run, collective where the velocity is a variable.
  void check_variables() const;
  void start_run();

  void atoms_migrated() { migrated_ = true; }

  /// Return whether atoms migrated, or wall atoms moved, since the last call, and reset this.
  bool take_migrated() { return std::exchange(migrated_, false); }
  bool take_moved() { return std::exchange(moved_, false); }

  bool moves() const;
  const std::array<double, 3> &velocity() const { return velocity_; }

  /// Evaluates the velocity at the end of the step that begins; `again` if the step is made once
  /// more, with another timestep. Collective where the velocity is a variable.
  void begin_step(bool again);

  /// Moves the atoms by what they travel from their present place to that at `fraction` of the
  /// step. The velocity is linear in time within a step.
  void place(double fraction);

  /// Forces of the fluid on an atom in the last evaluation, then those in the evaluation before it.
  static constexpr int NUMBERS = 6;
  double *forces(int i) const { return forces_[i]; }
  double **all_forces() const { return forces_; }
  void grow(int nmax);

  /// Force and torque of the fluid on the wall, about the mean place of its atoms. Collective.
  std::array<double, 6> total() const;

 private:
  std::string style_;
  int groupbit_;
  Settings settings_;
  bool migrated_ = true, moved_ = true;
  double **forces_ = nullptr;

  std::array<double, 3> velocity_start_{}, velocity_end_{}, velocity_{}, displaced_{};
  bool velocity_known_ = false;

  void evaluate();
};

}    // namespace LAMMPS_NS

#endif
