#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/ib,FixRBCIB);
// clang-format on
#else

#ifndef LMP_FIX_RBC_IB_H
#define LMP_FIX_RBC_IB_H

#include "coupling.h"
#include "fix.h"
#include "stopwatch.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixRBCIB : public Fix {
 public:
  FixRBCIB(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void post_run() override;
  double memory_usage() override;

  const std::string &fluid() const { return fluid_id; }    // ID of the fix rbc/fluid it drives

 private:
  enum class Integrator { EULER, MIDPOINT };

  std::string fluid_id;
  fluid::KernelKind kernel = fluid::KernelKind::peskin4;
  Integrator integrator = Integrator::MIDPOINT;

  class FixRBCFluid *fluid_fix = nullptr;
  std::vector<class FixRBCMembrane *> membranes, keepers;

  std::vector<int> members;             // atoms of the group here
  std::vector<double> start_of_step;    // their positions
  rbc::Stopwatch spreading, solving, interpolating, exchanging;
  bigint first_solve = 0, first_step = 0;
  bool late_forces =
      false;    // a fix defined after this one adds forces, which setup() does not see

  enum class Stage { START, MIDDLE };

  void update_velocities(Stage);
  void recompute_forces();
  void check_moves_all(const Fix *) const;
  void check_positions() const;
  void check_velocities() const;
  [[noreturn]] void stop(int, const std::string &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
