#ifndef LMP_RBC_SWELLING_H
#define LMP_RBC_SWELLING_H

#include "modify.h"
#include "support/rbc_number_or_variable.h"
#include "update.h"

namespace LAMMPS_NS {

/// Factor on the rest volume of cells, a number or a variable, now and a step before.
class Swelling {
 public:
  Swelling() = default;
  Swelling(const NumberOrVariable &given, LAMMPS *lmp) : factor(given)
  {
    if (!factor.is_variable()) state.now = state.before = factor.value(lmp);
  }

  bool varies() const { return factor.is_variable(); }
  void check(LAMMPS *lmp, const char *style) const { factor.check(lmp, style); }

  double now() const { return state.now; }
  double middle() const { return 0.5 * (state.before + state.now); }
  double change() const { return state.now - state.before; }

  /// Collective: evaluates the factor if it is a variable, unless that was done for this step and
  /// timestep. The value of the step before becomes `before`. If steps were skipped, or the value
  /// jumped between runs, `before` is the new value: no change within a step.
  void update(LAMMPS *lmp, bool new_run)
  {
    const auto step = static_cast<double>(lmp->update->ntimestep);
    const bool same = step == state.step;
    if (!varies() || (same && lmp->update->dt == dt && !new_run)) return;
    lmp->modify->clearstep_compute();
    const double value = factor.value(lmp);
    lmp->modify->addstep_compute(lmp->update->ntimestep + 1);
    if (step == state.step + 1)
      state.before = state.now;
    else if (!same || (new_run && value != state.now))
      state.before = value;
    state.now = value;
    state.step = step;
    dt = lmp->update->dt;
  }

  /// What a restart needs, all of it doubles.
  struct State {
    double now = 1, before = 1, step = -1;
  } state;

 private:
  NumberOrVariable factor;
  double dt = 0;    // at the last evaluation
};

}    // namespace LAMMPS_NS

#endif
