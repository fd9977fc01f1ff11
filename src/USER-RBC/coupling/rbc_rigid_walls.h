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

  /// At the start of a run: the evaluations that follow are for the time at which the next step
  /// begins.
  void start_clock();
  void begin_step(bool again);
  void place(double fraction);

  /// Collective; call between clear_force and accumulate_ghosts of a flow. Spreads the forces of
  /// the walls as extrapolated to `fraction` of the step. `others`: sum of all
  /// other forces of this rank. Reports to `stop` if an atom left this rank's part of the grid.
  /// Where the mean velocity is free, solve with mean() afterwards.
  void spread(fluid::Flow &flow, double fraction, const std::array<double, 3> &others,
              CollectiveStop &stop);

  /// Collective, once the flow is solved: corrects the forces, and the mean velocity where it is
  /// free.
  void enforce(fluid::Flow &flow);

  /// The mean velocity that balances forces, where it is free.
  const std::array<double, 3> &mean() const { return surface_.mean(); }

  /// From hold() on evaluations may be taken back: restore() forgets what they have changed of the
  /// walls, release() keeps it. hold() is collective.
  void hold(const fluid::Flow &flow);
  void restore();
  void release() { surface_.release(); }

  /// What evaluations need of those before them, on rank 0, empty elsewhere; for restart files.
  /// Where it does not fit into `most` numbers these walls forget it, too, so that both runs go on
  /// as one. Collective.
  std::vector<double> memory(const fluid::Flow &flow, std::size_t most);

  /// Takes that up with the next evaluation, if the walls have the same atoms and the flow is the
  /// same. On all ranks alike, before it.
  void remember(std::vector<double> memory) { remembered_ = std::move(memory); }

  const WallGroup *first() const { return walls_.front(); }

  // Numbers of the last evaluation; mean_solves() is the mean over the run.

  bigint evaluation() const { return evaluations_; }
  bool converged() const { return outcome_.converged; }
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

  // Times of the surface count from the start of the step or, before the first step of a run, from
  // the end of the last one.
  bool begun_ = false;    ///< a step of this run
  double span_ = 0;       ///< of the step, after an evaluation in it

  std::vector<double> remembered_;    ///< from a restart file, until the next evaluation

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
  bool set_remembered(const fluid::Flow &flow);
  void forget();
  void take_forces();
  void give_forces();
};

}    // namespace LAMMPS_NS

#endif
