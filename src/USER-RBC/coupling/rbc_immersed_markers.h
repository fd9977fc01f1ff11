#ifndef LMP_RBC_IMMERSED_MARKERS_H
#define LMP_RBC_IMMERSED_MARKERS_H

#include "coupling/rbc_implicit_viscosity.h"
#include "fluid/flow.h"
#include "motion/motion.h"
#include "support/rbc_step_part.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class CellMembranes;
class DrivenFlow;
class MassiveMarkers;

/// The atoms of a group as markers of a flow. Their velocity is a function of positions and time:
///   forces -> spread -> solve -> interpolate -> velocities,
/// and may be evaluated any number of times. Positions, velocities and forces are those of LAMMPS's
/// atoms. All calls are collective.
class ImmersedMarkers : public rbc::Motion, public StepPart, protected Pointers {
 public:
  struct Settings {
    fluid::KernelKind kernel = fluid::KernelKind::peskin4;
    double courant = 1;    ///< fluid cells that a marker may cross in a step
    bool timestep_follows =
        false;    ///< from the velocities at the start of a step, which may be of any size
  };

  /// `style` names the fix in errors.
  ImmersedMarkers(LAMMPS *lmp, std::string style, int groupbit, const Settings &settings);
  ~ImmersedMarkers() override;

  /// At the start of a run: the flow that they drive and the membranes that hold them together.
  void start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes,
                 fluid::MarkerKind kind);

  /// Viscosity of the membranes, solved for implicitly. Fluid with inertia: masses of the markers,
  /// or null.
  ImplicitViscosity &viscosity() { return viscosity_; }
  void set_masses(MassiveMarkers *masses) { masses_ = masses; }

  /// Who checks what is reported.
  const std::shared_ptr<CollectiveStop> &stop() const { return stop_; }

  /// After atoms migrated: finds this rank's.
  void find_members();
  const std::vector<int> &members() const { return members_; }
  bigint count() const;

  /// Three columns of a per-atom array, of the markers.
  void load(double **array, rbc::Numbers &numbers, int column = 0) const;
  void store(const rbc::Numbers &numbers, double **array, int column = 0) const;

  // of rbc::Motion; `velocity` leaves the atoms at `x`

  void velocity(const rbc::Numbers &x, double fraction, rbc::Numbers &v) override;
  void velocity_at_start(const rbc::Numbers &x, rbc::Numbers &v) override;
  void sum(double *values, int count) const override;
  std::int64_t label(std::size_t point) const override;
  void estimate_spectrum(bool on) override { estimating_spectrum_ = on; }

  using Stage = EvaluationStage;

  /// Velocities from the forces that the atoms hold, which may depend on the velocities that they
  /// hold.
  void velocities_from_forces(Stage stage);

  /// The same without viscosity and checks: what the flow of the forces gives.
  void velocities_of_flow(Stage stage);

  void constrain_volume(Stage stage);

  /// All forces at the positions and with the velocities of the atoms, as Verlet computes them at
  /// the end of a step.
  void recompute_forces();

  /// The flow's velocity at the markers, as it is.
  void interpolate();

  /// Velocities that the forces which the atoms hold would add, with a factor. `response` has a row
  /// for each atom here.
  void apply_mobility(double factor, rbc::Numbers &response);

  fluid::MarkerSet set() const;
  double fastest() const;

  /// Time in which the fastest marker crosses half of what it may.
  double longest_step() const;

  /// An error if a marker crosses too much in a step, or has no velocity. Markers beyond a plate
  /// are reported only.
  void check_velocities(Stage stage);
  void check_positions();

  /// What is wrong with an atom; ends the run at the next check of stop().
  void report_outside(int i);
  void report(int i, const std::string &what);

  void report_to(const std::shared_ptr<CollectiveStop> &driver) override { stop_ = driver; }
  std::vector<Section> sections() override { return {{"Exchange", &exchanging_}}; }

  std::size_t bytes() const;

 private:
  std::string style_;
  int groupbit_;
  Settings settings_;
  fluid::MarkerKind kind_ = fluid::MarkerKind::points;
  DrivenFlow *flow_ = nullptr;
  std::vector<CellMembranes *> volume_keepers_;
  std::vector<int> members_;
  ImplicitViscosity viscosity_;
  MassiveMarkers *masses_ = nullptr;
  std::shared_ptr<CollectiveStop> stop_;
  rbc::Stopwatch exchanging_;
  bool estimating_spectrum_ = false;
  rbc::Numbers applied_;    ///< a row for each atom here

  double *rows(double **array) const { return members_.empty() ? nullptr : array[0]; }
  void report_too_fast(Stage stage);
};

}    // namespace LAMMPS_NS

#endif
