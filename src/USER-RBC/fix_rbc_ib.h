#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/ib,FixRBCIB);
// clang-format on
#else

#ifndef LMP_FIX_RBC_IB_H
#define LMP_FIX_RBC_IB_H

#include "fix.h"
#include "fluid/direct_forcing.h"
#include "rbc_steady_steps.h"

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
  double courant() const { return motion->courant; }    // fluid cells that an atom may cross a step
  bool has_sheets() const;                              // its atoms are sheets of markers

 private:
  using Integrator = SteadySteps::Method;
  enum class Scheme { ELASTIC, DIRECT };
  enum class Sheets { WITH_MEMBRANES, YES, NO };
  using Stage = MarkerMotion::Stage;

  std::string fluid_id;
  Scheme scheme = Scheme::ELASTIC;
  Sheets sheets = Sheets::WITH_MEMBRANES;

  class FixRBCFluid *fluid_fix = nullptr;
  bool inertia = false;    // of the fluid
  std::vector<class FixRBCMembrane *> membranes;
  std::vector<class PairRBCJKR *> contacts;
  std::unique_ptr<MarkerMotion> motion;
  std::unique_ptr<SteadySteps> steady;

  bigint first_solve = 0, first_step = 0;
  bool late_forces = false;    // of a fix defined after this one, which setup() does not see

  // kept per atom while it migrates and in restart files

  std::string store_id;
  class FixStoreAtom *store = nullptr;
  int stored() const;

  rbc::Numbers start, velocity, position;    // of a step with inertia

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
  void advance_with_inertia();
  void step_fluid();
  void couple_masses();
  void check_moves_all(const Fix *) const;
  void check_apart(const Fix *wall) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
