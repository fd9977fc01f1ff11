#ifndef LMP_RBC_RIGID_WALLS_H
#define LMP_RBC_RIGID_WALLS_H

#include "fluid/rigid_surface.h"
#include "pointers.h"
#include "support/rbc_collective_stop.h"
#include "support/stopwatch.h"

#include <vector>

namespace LAMMPS_NS {

/// The walls (fix rbc/wall) of a fluid, whose forces on it are found together.
class RigidWalls : protected Pointers {
 public:
  explicit RigidWalls(LAMMPS *lmp) : Pointers(lmp) {}

  /// At the start of a run. `free_mean`: the mean velocity follows from the balance of forces. False if there are none.
  bool connect(const std::string &fluid_id, bool free_mean);

  void atoms_migrated() { migrated_ = true; }
  void walls_moved() { moved_ = true; }

  bool moves() const;
  void begin_step(bool again);
  void place(double fraction);

  /// Between clear_force and gather_force of a flow; `others` as for fluid::RigidSurface. Reports to `stop`.
  void spread(fluid::Flow &flow, double time, const fluid::Vec3 &others, CollectiveStop &stop);

  /// Once the flow is solved.
  void enforce(fluid::Flow &flow);

  const class FixRBCWall *first() const { return walls_.front(); }

  // of the last evaluation, but for the mean over those of the run

  bigint evaluation() const { return evaluations_; }
  double slip() const { return outcome_.slip; }
  int last_solves() const { return outcome_.solves; }
  double mean_solves() const;

  void reset_counts();
  void warn() const;
  rbc::Stopwatch stopwatch;
  std::size_t bytes() const;

 private:
  std::vector<FixRBCWall *> walls_;
  fluid::RigidSurface surface_;
  fluid::RigidSurface::Outcome outcome_;
  bool migrated_ = true, moved_ = true, known_ = false;

  struct Marker {
    tagint tag;
    int atom, wall;
  };
  std::vector<Marker> markers_;    // of this task, by tag
  std::vector<tagint> tags_;
  std::vector<double> position_;
  std::vector<int> body_;

  bigint evaluations_ = 0, first_evaluation_ = 0, solves_ = 0, unconverged_ = 0;

  void find_markers(const fluid::Flow &flow);
};

}    // namespace LAMMPS_NS

#endif
