#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/fluid,FixRBCFluid);
// clang-format on
#else

#ifndef LMP_FIX_RBC_FLUID_H
#define LMP_FIX_RBC_FLUID_H

#include "coupling/rbc_centred_data.h"
#include "coupling/rbc_flow_drive.h"
#include "coupling/rbc_flow_inside.h"
#include "coupling/rbc_flow_restart.h"
#include "coupling/rbc_fluid_settings.h"
#include "fix.h"
#include "fluid/measures.h"
#include "support/rbc_collective_stop.h"

#include <array>
#include <memory>

namespace LAMMPS_NS {

class FixRBCFluid : public Fix {
 public:
  FixRBCFluid(class LAMMPS *, int, char **);
  ~FixRBCFluid() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_run() override;
  void final_integrate() override;
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

  // used by fix rbc/wall and by fix rbc/ib, which drives the flow

  fluid::Flow &flow() { return *current_flow; }
  bool has_inertia() const { return settings.regime.inertia != fluid::Inertia::none; }
  void drive_at_setup();
  void drive_now();
  bool holds_inside() const { return drive.held_direction() >= 0; }
  bool correct_drive();
  void begin_step(bool again = false);
  void drive_at(double fraction);
  void drive_end();
  void flow_changed();
  bigint solves() const { return current_flow->solves() + earlier_solves; }
  double smallest_spacing() const;

  bool is_driven() const { return driven; }
  class RigidWalls *rigid_walls() const { return rigid.get(); }

  /// Both do nothing without walls: before gather_force and after solve. `others` is this task's sum of all other forces
  /// on the fluid.
  void spread_walls(const std::array<double, 3> &others, CollectiveStop &stop);
  void enforce_walls();
  void place_walls(double fraction);

  void count_from_here();
  std::string costs(bigint steps) const;

 private:
  double box_lo[3], box_hi[3];    // when the grid was chosen
  FluidSettings settings;
  bool balanced = false;    // the mean velocity follows from the forces of walls
  FlowDrive drive;

  std::unique_ptr<class Grid3d> grid;
  std::unique_ptr<fluid::Flow> current_flow;
  int ghost_layers = -1;
  bool driven = false;               // by a fix rbc/ib
  double cells_per_step = 1;         // that its atoms may cross
  bool sheets = false;               // its atoms are sheets
  bigint earlier_solves = 0;         // before a restart
  bigint version = 0;                // of the velocity
  fluid::Traffic earlier_traffic;    // on earlier decompositions
  fluid::Traffic first_traffic;      // at the start of the run
  bigint first_step = 0, first_solve = 0;

  fluid::FlowMeasures measures;
  bigint measured_version = -1;

  std::unique_ptr<FlowInside> inside;

  CentredData centred;
  FlowRestart restarts;
  CollectiveStop stop;

  std::unique_ptr<RigidWalls> rigid;    // surfaces of atoms; null without them
  double fraction = 1;                  // of the step, at which the forcing is
  fluid::Drive forcing;                 // of the next solves

  void find_walls();
  int layers_needed() const;
  void build_flow();
  void advance_alone();
  void check_courant();
  void report_too_fast(const std::array<double, 3> &x, double courant);
  fluid::Traffic traffic() const;
  const fluid::FlowMeasures &measure();
  double inside_value(int);
  const fluid::Vec3 &mean_inside();
  void set_forcing(const fluid::Drive &);
  bool holds_box_mean() const { return !settings.plates && settings.regime.hold_mean && !balanced; }
  void start_control();
  double driving_force(int) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
