#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/ib,FixRBCIB);
// clang-format on
#else

#ifndef LMP_FIX_RBC_IB_H
#define LMP_FIX_RBC_IB_H

#include "coupling.h"
#include "direct_forcing.h"
#include "fix.h"
#include "stopwatch.h"

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

 private:
  enum class Integrator { EULER, MIDPOINT };
  enum class Scheme { ELASTIC, DIRECT };

  std::string fluid_id;
  fluid::KernelKind kernel = fluid::KernelKind::peskin4;
  Integrator integrator = Integrator::MIDPOINT;
  Scheme scheme = Scheme::ELASTIC;

  class FixRBCFluid *fluid_fix = nullptr;
  std::vector<class FixRBCMembrane *> membranes, keepers;

  std::vector<int> members;             // atoms of the group here
  std::vector<double> start_of_step;    // their positions
  rbc::Stopwatch spreading, solving, interpolating, exchanging;
  bigint first_solve = 0, first_step = 0;
  bool late_forces =
      false;    // a fix defined after this one adds forces, which setup() does not see

  // scheme direct: markers with mass

  fluid::DirectForcing direct;
  std::string store_id;
  class FixStoreAtom *store = nullptr;
  // Per atom: velocity in the middle of the step before the last, inertial force, what the last velocity misses of
  // what the forces would have made it (so that errors below the tolerance do not add up), steps known (0 to 2).
  static constexpr int OLDER = 0, INERTIAL = 3, MISSING = 6, STEPS = 9, NSTORED = 10;
  double last_dt = 0, last_between = 0;    // time between the middles of the last two steps
  std::vector<double> applied, resistance, target, inertial;
  bigint unconverged = 0;
  double last_error = 0;
  double exerted[3] = {0, 0, 0};    // by this task's atoms on the fluid

  enum class Stage { START, MIDDLE };

  void move(double);
  void update_velocities(Stage);
  void spread_forces();
  void interpolate(Stage);
  void step_fluid();
  void couple_masses();
  void recompute_forces();
  void check_moves_all(const Fix *) const;
  void check_positions() const;
  void check_velocities() const;
  fluid::Markers markers() const;
  double *rows(double **) const;
  [[noreturn]] void stop_outside(int) const;
  [[noreturn]] void stop(int, const std::string &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
