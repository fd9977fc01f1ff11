#ifndef LMP_RBC_MARKER_MOTION_H
#define LMP_RBC_MARKER_MOTION_H

#include "fluid/flow.h"
#include "motion/gmres.h"
#include "pointers.h"
#include "support/rbc_collective_stop.h"
#include "support/stopwatch.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// The atoms of a group as markers of a fluid: forces -> spread -> solve -> interpolate -> velocities, at positions
/// within a step too. Velocities and positions are those of LAMMPS's atoms.
class MarkerMotion : protected Pointers, public rbc::Motion {
 public:
  enum class Stage { START, MIDDLE };

  MarkerMotion(LAMMPS *lmp, std::string style, int groupbit, fluid::KernelKind kernel);

  /// At the start of a run: whom it drives and whose forces it finds.
  void connect(class FixRBCFluid *fluid, const std::vector<class FixRBCMembrane *> &membranes);

  /// After atoms migrated.
  void find_markers();

  const std::vector<int> &members() const { return members_; }
  fluid::Markers markers() const;

  /// Velocities from the forces that the atoms hold, which may depend on the velocities that they hold.
  void update_velocities(Stage stage);

  void spread_forces();
  void solve();
  void interpolate(Stage stage);
  void keep_volume(Stage stage);

  /// All forces at the positions and with the velocities of the atoms, as Verlet computes them at the end of a step.
  void recompute_forces();

  /// Three columns of a per-atom array, of the group's atoms.
  void load(double **array, rbc::Numbers &numbers, int column = 0) const;
  void store(const rbc::Numbers &numbers, double **array, int column = 0) const;

  void velocity(const rbc::Numbers &x, double fraction, rbc::Numbers &v) override;
  void sum(double *values, int count) const override;

  bool is_viscous() const { return !viscous_.empty(); }

  /// Atoms must not cross more fluid cells in a step: checked when they take velocities, but not those at the start of
  /// a step whose timestep follows from them. They must stay between plates: reported only.
  double courant = 1;
  bool timestep_follows = false;
  void check_velocities(Stage stage);
  void check_positions();

  double fastest() const;

  /// Time in which the fastest atom crosses half of what it may.
  double longest_step() const;
  double *rows(double **array) const { return members_.empty() ? nullptr : array[0]; }

  /// What is wrong with an atom: ends the run when all tasks check `stop`, which they do before the next solve.
  void report_outside(int i);
  void report(int i, const std::string &what);
  std::shared_ptr<CollectiveStop> stop;

  /// Velocities are those of positions that the atoms do not take, of any size, without viscous forces and without
  /// rigid walls, which make what relaxes slower.
  bool probing = false;

  /// What the markers are to the flow.
  fluid::Flow::As as = fluid::Flow::As::points;

  /// Error allowed in the velocities where forces depend on them, relative to the fastest marker.
  double tolerance = 1e-4;
  rbc::Gmres gmres;
  bigint unconverged = 0;    // evaluations

  rbc::Stopwatch spreading, solving, interpolating, exchanging;
  void reset_stopwatches();

  std::size_t numbers() const;

 private:
  std::string style_;
  int groupbit_;
  fluid::KernelKind kernel_;
  FixRBCFluid *fluid_ = nullptr;
  std::vector<FixRBCMembrane *> keepers_, viscous_;
  std::vector<int> members_;

  rbc::Numbers guess_, forces_, residual_, correction_;
  rbc::Numbers applied_, response_;    // of all atoms here

  void velocities_of_forces(Stage stage);
  std::array<double, 3> total_force() const;
  void report_too_fast(Stage stage);
  void find_residual();
  void correct_forces();
  void resistance(const rbc::Numbers &p, rbc::Numbers &v);
};

}    // namespace LAMMPS_NS

#endif
