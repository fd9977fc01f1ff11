#ifndef LMP_RBC_STEADY_STEPS_H
#define LMP_RBC_STEADY_STEPS_H

#include "motion/chebyshev.h"
#include "motion/spectral_radius.h"
#include "motion/step_control.h"
#include "rbc_marker_motion.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

/// Time steps of markers in a fluid without inertia.
class SteadySteps : protected Pointers {
 public:
  enum class Method { EULER, MIDPOINT, AB2, RKC };

  SteadySteps(LAMMPS *lmp, std::string style, MarkerMotion &motion);

  /// `stages` of 0: as few as are stable. A control with a tolerance of 0 leaves LAMMPS's timestep alone.
  void choose(Method method, int stages, int order, double tolerance, double largest_dt);

  Method method() const { return method_; }
  bool adaptive() const { return control_.active(); }

  /// Numbers that must be kept for each atom, while it migrates and in restart files; 0 at first.
  int numbers_per_atom() const;
  void keep_in(class FixStoreAtom *store) { store_ = store; }

  /// At the start of a run; `forces_change` if the forces of the first step are not those of the setup.
  void start_run(class FixRBCFluid *fluid, bool forces_change);
  void atoms_migrated();

  /// The atoms hold positions and velocities of the start of the step, then positions of its end.
  void advance();

  /// Velocities at the end of the step.
  void finish();

  int stages() const { return method_ == Method::RKC ? chebyshev_.stages() : 0; }
  double radius() const { return radius_; }
  double local_error() const { return local_error_; }
  bigint rejected() const { return rejected_; }
  bigint failed() const { return failed_; }    ///< of these: went wrong altogether
  const std::string &last_failure() const { return last_failure_; }
  double last_dt() const { return last_dt_; }

  static constexpr int NSTATE = 2 + rbc::Path::LONGEST;
  using State = std::array<double, NSTATE>;
  State state() const;
  void restart(const double *state);

  std::size_t numbers() const;

 private:
  std::string style_;
  MarkerMotion &motion_;
  Method method_ = Method::MIDPOINT;
  FixRBCFluid *fluid_ = nullptr;
  FixStoreAtom *store_ = nullptr;
  bigint first_step_ = 0;
  bool forces_change_ = false;

  // a step: positions and velocities at its start, velocities within it, positions at its end
  rbc::Numbers start_, velocity_, middle_, position_, scratch_;
  double last_dt_ = 0;

  // rkc
  rbc::ChebyshevMethod chebyshev_;
  rbc::Path path_;
  std::array<double, rbc::Path::LONGEST> past_dt_{};
  int known_steps_ = 0;    // of the path, of all atoms
  bool automatic_stages_ = false;
  rbc::SpectralRadius spectrum_;
  double radius_ = 0;
  double raw_radius_ = 0;     // the last estimate as it was
  bool suspected_ = false;    // the mode has a part that a step refused has grown by
  bigint radius_step_ = -1,
         estimated_step_ = -1;    // the former is forgotten when a step is rejected
  int radius_interval_ = 0;

  rbc::StepControl control_;
  double next_dt_ = 0, local_error_ = 0;
  bool restarted_ = false;
  bool velocities_known_ = false;    // those at the end of the step, before LAMMPS computes forces
  bigint rejected_ = 0, failed_ = 0;
  std::string last_failure_;

  // Columns: whether the atom has a past; ab2 the velocity at the start of the last step, rkc the displacements in the
  // last steps; the fastest mode.
  static constexpr int KNOWN = 0, PAST = 1;
  int mode_column() const
  {
    return chebyshev_.past_steps() > 0 ? PAST + 3 * chebyshev_.past_steps() : 0;
  }

  void move();
  void move_ab2();
  void move_chebyshev();
  void start_chebyshev();
  void estimate_radius();
  void foresee_radius(double last);
  void choose_stages(double dt);
  void remember();
  bool attempt();
  void measure_error();
  void stop_adapting(const std::string &flaw);
  void set_timestep(double dt, bigint from_step);
};

}    // namespace LAMMPS_NS

#endif
