#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/fluid,FixRBCFluid);
// clang-format on
#else

#ifndef LMP_FIX_RBC_FLUID_H
#define LMP_FIX_RBC_FLUID_H

#include "coupling/rbc_driven_flow.h"
#include "coupling/rbc_flow_restart.h"
#include "coupling/rbc_grid_output.h"
#include "fix.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

/// A fluid: arguments, checks, output and LAMMPS's hooks.
class FixRBCFluid : public Fix {
 public:
  FixRBCFluid(class LAMMPS *, int, char **);
  int setmask() override;
  int modify_param(int, char **) override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void post_run() override;
  void reset_grid() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  int get_grid_by_name(const std::string &, int &) override;
  void *get_grid_by_index(int) override;
  int get_griddata_by_name(int, const std::string &, int &) override;
  void *get_griddata_by_index(int) override;

  DrivenFlow &driven_flow() { return *flow; }

 private:
  double box_lo[3], box_hi[3];    // when the grid was chosen
  std::unique_ptr<DrivenFlow> flow;
  GridOutput grid_output;
  FlowRestart restarts;
  CollectiveStop stop;

  void check_box() const;
  void check_unchanged() const;
  void check_averages() const;
  void check_drivers() const;
  void advance_alone();
  double inside_value(int);
};

}    // namespace LAMMPS_NS

#endif
#endif
