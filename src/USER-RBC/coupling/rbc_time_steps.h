#ifndef LMP_RBC_TIME_STEPS_H
#define LMP_RBC_TIME_STEPS_H

#include "coupling/rbc_atom_store.h"
#include "coupling/rbc_driven_flow.h"
#include "motion/integrator.h"
#include "motion/step_control.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class CellCrossings;

/// Time steps of markers and flow: an integrator, the choice of the timestep, and LAMMPS's clock.
/// All calls are collective.
class TimeSteps : protected Pointers {
 public:
  /// `style` names the fix in errors. A control without a tolerance leaves LAMMPS's timestep alone.
  TimeSteps(LAMMPS *lmp, std::string style, ImmersedMarkers &markers,
            std::unique_ptr<rbc::Integrator> integrator, double tolerance, double largest_dt);

  const rbc::Integrator &integrator() const { return *integrator_; }
  void set_integrator(std::unique_ptr<rbc::Integrator> integrator);
  bool adaptive() const { return control_.active(); }

  /// Columns that must be kept for each atom, in `store`; 0 at first.
  int columns() const { return AtomStore::columns(*integrator_); }
  void keep_in(FixStoreAtom *store) { store_.keep_in(store, *integrator_); }

  /// Call at the start of a run. `forces_change`: fixes defined after this one add forces that its
  /// setup() did not see, so that the first step computes its velocities anew.
  void start_run(DrivenFlow *flow, bool forces_change);
  void atoms_migrated();

  /// Sets the velocities from which the first step of a run starts. Where a flow rate is held, two
  /// more evaluations find how it responds.
  void setup();

  /// Makes a step. On entry the atoms hold positions and velocities of its start; on return atom->x
  /// holds the positions of its end. With a bound on the error the step is repeated with shorter
  /// timesteps until it meets the bound; it is an error if none does.
  void advance();

  /// Sets atom->v to the velocities at the end of the step, from the forces that LAMMPS has
  /// computed there. With fluid inertia they stay those of the middle of the step.
  void finish();

  /// The velocities at the end of the step, where advance() knows them, are of other atoms.
  void forget_velocities() { velocities_known_ = false; }

  double local_error() const { return local_error_; }
  bigint rejected() const { return rejected_; }
  bigint failed() const { return failed_; }    ///< of these: went wrong altogether
  const std::string &last_failure() const { return last_failure_; }    ///< empty if none did
  double last_dt() const { return last_dt_; }

  /// Last timestep, next timestep, step of the last velocities, what the integrator keeps.
  static constexpr int NSTATE = 3 + rbc::Integrator::STATE;
  using State = std::array<double, NSTATE>;
  State state() const;
  void restart(const double *state);

  /// The numbers that files had before they held all: last timestep, next timestep, timesteps
  /// before.
  void restart_from_before(const double *state);

  std::size_t bytes() const;

 private:
  std::string style_;
  ImmersedMarkers &markers_;
  DrivenFlow *flow_ = nullptr;
  std::vector<CellCrossings *> crossings_;    ///< of pair styles in which surfaces of cells act
  std::unique_ptr<rbc::Integrator> integrator_;
  AtomStore store_;
  rbc::StepControl control_;
  bigint first_step_ = 0;
  bigint velocity_step_ = -1;         ///< at whose end the atoms' velocities were found; -1: none
  bool doubts_velocities_ = false;    ///< they are still to be compared with those of the forces
  int tries_ = 0;                     ///< of this step
  std::vector<Flaw> seen_;            ///< in these
  bool forces_change_ = false;
  std::string acting_;            ///< what acts on the markers in this run
  bool forces_differ_ = false;    ///< from those of the run before

  // Of the present step, three numbers for each marker here: positions and velocities at its start,
  // and positions at its end.
  rbc::Numbers X_, V_, X_new_;
  double last_dt_ = 0, next_dt_ = 0, local_error_ = 0;
  bool restarted_ = false;    ///< and no run has begun since
  /// The atoms hold the velocities at the end of the step already: finish() need not compute them.
  bool velocities_known_ = false;
  bigint rejected_ = 0, failed_ = 0;
  std::string last_failure_;

  rbc::StepStart start() const { return {X_, V_, update_dt(), last_dt_, step()}; }
  double update_dt() const;
  bigint step() const;
  std::string what_acts() const;
  void find_crossings();
  void report_crossings();
  void start_velocities();
  void show_velocities();
  void compare_velocities();
  bool are_velocities_same();
  void choose_timestep();
  void take_step();
  bool step_is_accepted();
  bool try_step();
  void check_result();
  void measure_error();
  void note_failure(const std::string &what, Flaw flaw);
  void stop_adapting(bool went_wrong);
  void stop_retaking();
  void set_timestep(double dt, bigint from_step);
};

}    // namespace LAMMPS_NS

#endif
