#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/wall,FixRBCWall);
// clang-format on
#else

#ifndef LMP_FIX_RBC_WALL_H
#define LMP_FIX_RBC_WALL_H

#include "fix.h"
#include "fluid/coupling.h"
#include "support/rbc_number_or_variable.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

class FixRBCWall : public Fix {
 public:
  FixRBCWall(class LAMMPS *, int, char **);
  ~FixRBCWall() override;
  int setmask() override;
  void init() override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void initial_integrate(int) override;
  double compute_vector(int) override;
  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;

  // used by RigidWalls, which enforces all walls of a fluid together

  const std::string &fluid() const { return fluid_id; }    // ID of the fix rbc/fluid
  const std::string &style_name() const { return name; }
  fluid::KernelKind kernel = fluid::KernelKind::peskin4;
  double tolerance = 1.0e-3;
  int max_solves = 100;

  bool moves() const;
  const std::array<double, 3> &velocity() const { return velocity_now; }

  /// Velocities at the end of the step that begins; `again` if it is tried once more, with another timestep.
  void begin_step(bool again);

  /// Moves atoms and velocity to where they are at a fraction of the step.
  void place(double fraction);

  /// Forces of the fluid on each atom in the last evaluation and in that before it.
  static constexpr int NUMBERS = 6;
  double **forces = nullptr;

 private:
  std::string fluid_id, name;
  std::array<NumberOrVariable, 3> prescribed;
  class FixRBCFluid *fluid_fix = nullptr;

  std::array<double, 3> velocity_start{}, velocity_end{}, velocity_now{}, displaced{};
  bool velocity_known = false;

  bigint measured = -1;    // evaluation of the fluid
  double sums[6];

  void parse(int, char **);
  void evaluate();
  void measure();
};

}    // namespace LAMMPS_NS

#endif
#endif
