#ifndef LMP_RBC_RIGID_WALLS_H
#define LMP_RBC_RIGID_WALLS_H

#include "coupling/rbc_wall_group.h"
#include "fluid/rigid_surface.h"
#include "support/rbc_step_part.h"

#include <vector>

namespace LAMMPS_NS {

/// The walls of a fluid, whose forces on it are found together.
class RigidWalls : public StepPart, protected Pointers {
 public:
  explicit RigidWalls(LAMMPS *lmp) : Pointers(lmp) {}

  /// Collective, at the start of a run. `free_mean`: the mean velocity follows from the balance of
  /// forces.
  void connect(const std::vector<WallGroup *> &walls, bool free_mean);

  bool moves() const;

  /// Speed of the fastest wall, and the fixes as a list for messages.
  double fastest() const;
  std::string names() const;

  void begin_step(bool again);
  void place(double fraction);

  /// Collective; call between clear_force and accumulate_ghosts of a flow. Spreads the forces of
  /// the walls as extrapolated to `time` (elapsed time of the simulation). `others`: sum of all
  /// other forces of this rank. Reports to `stop` if an atom left this rank's part of the grid.
  /// Where the mean velocity is free, solve with mean() afterwards.
  void spread(fluid::Flow &flow, double time, const std::array<double, 3> &others,
              CollectiveStop &stop);

  /// Collective, once the flow is solved: corrects the forces, and the mean velocity where it is
  /// free.
  void enforce(fluid::Flow &flow);

  /// The mean velocity that balances forces, where it is free.
  const std::array<double, 3> &mean() const { return surface_.mean(); }

  const WallGroup *first() const { return walls_.front(); }

  // Numbers of the last evaluation; mean_solves() is the mean over the run.

  bigint evaluation() const { return evaluations_; }
  double slip() const { return outcome_.slip; }
  int last_solves() const { return outcome_.solves; }
  double mean_solves() const;

  void reset_counts();
  void warn() const;

  void report_to(const std::shared_ptr<CollectiveStop> & /*stop*/) override {}
  std::vector<Section> sections() override { return {{"Walls", &stopwatch_}}; }

  std::size_t bytes() const;

 private:
  std::vector<WallGroup *> walls_;
  fluid::RigidSurface surface_;
  fluid::RigidSurface::Outcome outcome_;
  rbc::Stopwatch stopwatch_;
  bool surface_is_set_ = false;    ///< surface_ holds the forces of these atoms

  struct Marker {
    tagint tag;
    int atom, wall;
  };
  std::vector<Marker> markers_;    // of this rank, by tag
  std::vector<tagint> tags_;
  std::vector<double> position_;
  std::vector<int> body_;

  bigint evaluations_ = 0, first_evaluation_ = 0, solves_ = 0, unconverged_ = 0;

  enum class Change { none, places, atoms };

  bool has_atom(const WallGroup &wall, int i) const;
  void check_settings(const WallGroup &wall) const;
  void check_atoms(const WallGroup &wall) const;
  void find_markers(const fluid::Flow &flow);
  void collect_markers();
  Change find_change();
  bool take_tags();
  void set_markers(const fluid::Flow &flow);
};

}    // namespace LAMMPS_NS

#endif
