#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/ib,FixRBCIB);
// clang-format on
#else

#ifndef LMP_FIX_RBC_IB_H
#define LMP_FIX_RBC_IB_H

#include "chebyshev.h"
#include "direct_forcing.h"
#include "fix.h"
#include "rbc_marker_motion.h"
#include "spectral_radius.h"
#include "step_control.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixRBCIB : public Fix {
 public:
  FixRBCIB(class LAMMPS *, int, char **);
  ~FixRBCIB() override;
  void post_constructor() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void post_run() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void set_arrays(int) override;

  const std::string &fluid() const { return fluid_id; }    // ID of the fix rbc/fluid it drives
  double courant() const
  {
    return motion->courant;
  }    // fluid cells that an atom may cross in a step

 private:
  enum class Integrator { EULER, MIDPOINT, AB2, RKC };
  enum class Scheme { ELASTIC, DIRECT };
  using Stage = MarkerMotion::Stage;

  std::string fluid_id;
  Integrator integrator = Integrator::MIDPOINT;
  Scheme scheme = Scheme::ELASTIC;

  class FixRBCFluid *fluid_fix = nullptr;
  std::vector<class FixRBCMembrane *> membranes;
  std::unique_ptr<MarkerMotion> motion;

  bigint first_solve = 0, first_step = 0;
  bool late_forces =
      false;    // a fix defined after this one adds forces, which setup() does not see

  // a step: positions and velocities at its start, velocities within it, positions at its end

  rbc::Numbers start, velocity, middle, position, scratch;

  // integrator rkc; with automatic stages from the fastest mode

  rbc::ChebyshevMethod chebyshev;
  rbc::Path path;
  std::array<double, rbc::Path::LONGEST> past_dt{};
  int known_steps = 0;    // of the path, of all atoms
  bool automatic_stages = false;
  rbc::SpectralRadius spectrum;
  double radius = 0;
  bigint radius_step = -1;

  // timestep by error

  rbc::StepControl control;
  double next_dt = 0, last_error = 0;
  bool velocities_known =
      false;    // those at the end of the step, before LAMMPS computed the forces there
  bigint rejected = 0;

  // per atom, kept while it migrates and in restart files

  std::string store_id;
  class FixStoreAtom *store = nullptr;
  int stored() const;

  // Whether it has a past comes first: ab2 the velocity at the start of the last step, rkc the displacements in the
  // last steps, then the fastest mode.
  static constexpr int KNOWN = 0, PAST = 1;
  int mode_column() const
  {
    return chebyshev.past_steps() > 0 ? PAST + 3 * chebyshev.past_steps() : 0;
  }

  // scheme direct: markers with mass

  fluid::DirectForcing direct;
  fluid::KernelKind kernel = fluid::KernelKind::peskin4;
  // Per atom: velocity in the middle of the step before the last, inertial force, what the last velocity misses of
  // what the forces would have made it (so that errors below the tolerance do not add up), steps known (0 to 2).
  static constexpr int OLDER = 0, INERTIAL = 3, MISSING = 6, STEPS = 9;
  double last_dt = 0, last_between = 0;    // time between the middles of the last two steps
  std::vector<double> applied, resistance, target, inertial;
  bool iterates = false;    // keywords of iterations were given
  bigint unconverged = 0;
  double coupling_error = 0;
  double exerted[3] = {0, 0, 0};    // by this task's atoms on the fluid

  void parse(int, char **);
  void advance();
  void advance_ab2();
  void advance_chebyshev();
  void start_chebyshev();
  void estimate_radius();
  void choose_stages(double);
  void remember();
  void advance_with_inertia();
  void step_fluid();
  void couple_masses();
  bool accept_step();
  void set_timestep(double);
  void check_moves_all(const Fix *) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
