#ifndef LMP_RBC_IMMERSED_MARKERS_H
#define LMP_RBC_IMMERSED_MARKERS_H

#include "coupling/rbc_implicit_velocity.h"
#include "coupling/rbc_unfinished_flow.h"
#include "fluid/flow.h"
#include "motion/motion.h"
#include "support/rbc_step_part.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class CellMembranes;
class DrivenFlow;
class GapSlip;
class ViscosityContrast;
class TractionFilter;
class MassiveMarkers;

/// The atoms of a group as markers of a flow. Their velocity is a function of positions and time:
///   forces -> spread -> solve -> interpolate -> velocities,
/// and may be evaluated any number of times. Positions, velocities and forces are those of LAMMPS's
/// atoms. All calls are collective.
class ImmersedMarkers : public rbc::Motion,
                        public StepPart,
                        public UnfinishedFlow,
                        protected Pointers {
 public:
  struct Settings {
    fluid::KernelKind kernel = fluid::default_kernel;
    double courant = 1;    ///< fluid cells that a marker may cross in a step
  };

  /// `style` names the fix in errors.
  ImmersedMarkers(LAMMPS *lmp, std::string style, int groupbit, const Settings &settings);
  ~ImmersedMarkers() override;

  /// At the start of a run: the flow that they drive and the membranes that hold them together.
  void start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes,
                 fluid::MarkerKind kind, ViscosityContrast *contrast);

  /// Solver where forces or the flow depend on the velocities.
  ImplicitVelocity &implicit() { return implicit_; }

  /// Gives the markers masses (fluid with inertia, scheme direct); null: they have none.
  void set_masses(MassiveMarkers *masses) { masses_ = masses; }

  /// Lets surfaces slide in gaps narrower than the grid; null: they do as the grid lets them. Set
  /// at the start of a run.
  void set_gap_slip(GapSlip *gaps) { gaps_ = gaps; }

  /// Smooths the tractions of membranes; null: of none. Set at the start of a run.
  void set_traction_filter(TractionFilter *filter) { filter_ = filter; }

  /// Collects errors of this fix, its membranes and pair styles; its check() ends the run or
  /// rejects the step.
  const std::shared_ptr<CollectiveStop> &stop() const { return stop_; }

  /// Between steps velocities may be of any size: it is tried whether the next step can be taken.
  /// Set at the start of a run.
  void allow_any_speed_between_steps(bool any) { any_speed_between_steps_ = any; }

  /// Between steps, and at the start of a run, the atoms are as the last evaluation left them: only
  /// then can its flow be finished. A fix whose forces depend on the flow looks at it at other
  /// times, and gets it as it is. From then on the flow is finished at the end of each step of this
  /// run, so that these forces do not depend on when output looked at it. Collective.
  void between_steps(bool yes);

  /// Makes `v` the velocities of the last evaluation of this step, if there was one.
  void guess_velocities(rbc::Numbers &v) const;
  void forget_velocities() { last_found_.clear(); }

  /// Finds the local indices of the group's atoms on this rank; call after atoms migrated. Not
  /// collective.
  void find_members();
  const std::vector<int> &members() const { return members_; }
  bigint count() const;

  /// Copies columns `column` to `column` + 2 of a per-atom array into `numbers`, three for each of
  /// members(), or back. Not collective.
  void load(double **array, rbc::Numbers &numbers, int column = 0) const;
  void store(const rbc::Numbers &numbers, double **array, int column = 0) const;

  // Functions of rbc::Motion. velocity() works on LAMMPS's own atoms: afterwards atom->x is `x`,
  // atom->v is `v`, atom->f are the forces there, and walls stand at their places at `fraction`.

  void velocity(const rbc::Numbers &x, double fraction, rbc::Numbers &v) override;
  void velocity_at_start(const rbc::Numbers &x, rbc::Numbers &v) override;
  void velocity_at_end(const rbc::Numbers &x, rbc::Numbers &v);
  void sum(double *values, int count) const override;
  std::int64_t label(std::size_t point) const override;
  void estimate_spectrum(bool on) override;
  void complete_change(rbc::Numbers &change) override { implicit_.complete_change(change); }
  void divide_step(int parts) override { parts_ = parts; }

  using Stage = EvaluationStage;

  /// Replaces atom->v of the markers by the velocities that the flow of atom->f gives them. Checks
  /// them, and with fluid inertia ends the fluid's step. If membranes are viscous, atom->f must
  /// contain the viscous forces at the atom->v of the call. Collective.
  void velocities_from_forces(Stage stage);

  /// Does the same, but takes all forces as given, and atom->v as the velocities on which the flow
  /// depends: no implicit solution, no check of the speeds, no end of the fluid's step.
  void velocities_of_flow(Stage stage);

  /// Changes atom->v such that cells keep their volumes, as CellMembranes::constrain_volume() does.
  void constrain_volume(Stage stage);

  /// Changes atom->v such that no volume changes.
  void remove_volume_change();

  void finish_velocity() override;
  void finish_viscosity() override;

  /// All forces at the positions and with the velocities of the atoms, as Verlet computes them at
  /// the end of a step.
  void recompute_forces();

  /// Sets atom->v of the markers to the present velocity of the flow, corrected so that cells keep
  /// their volumes. No solve.
  void interpolate();

  /// Computes the velocities that further forces atom->f on the markers would give them, if there
  /// are any, and, where the flow depends on velocities, further velocities atom->v. Walls are left
  /// out. `response` becomes three numbers for each of the nlocal atoms, valid for members(). Costs
  /// one solve of the flow.
  void apply_mobility(bool with_forces, rbc::Numbers &response);

  fluid::MarkerSet set() const;
  double fastest() const;

  /// Timestep in which the fastest marker crosses half of `courant` cells; infinite if none moves.
  /// Collective.
  double longest_step() const;

  /// Whether a triangle of a membrane was close to a fold when forces were last computed.
  /// Collective.
  bool is_nearly_folded() const;

  /// Reports a marker that would cross more than `courant` cells in a step, or whose velocity is
  /// not a number, and checks stop(): collective, ends the run or throws FailedTrial.
  void check_velocities(Stage stage);

  /// Reports a marker beyond a plate to stop(), which must be checked later. Not collective.
  void check_positions();

  /// Reports a marker that has moved by more than `courant` cells from `start` to `end`. Not
  /// collective.
  void check_displacements(const rbc::Numbers &start, const rbc::Numbers &end);

  /// Reports that `what` is wrong with local atom i. The next check of stop() ends the run or
  /// rejects the step. Not collective.
  void report_outside(int i);
  void report(int i, const std::string &what, Flaw flaw = Flaw::other);

  void report_to(const std::shared_ptr<CollectiveStop> &stop) override { stop_ = stop; }
  std::vector<Section> sections() override { return {{"Exchange", &exchanging_}}; }

  std::size_t bytes() const;

 private:
  std::string style_;
  int groupbit_;
  Settings settings_;
  fluid::MarkerKind kind_ = fluid::MarkerKind::points;
  DrivenFlow *flow_ = nullptr;
  std::vector<CellMembranes *> membranes_, volume_keepers_;
  std::vector<int> members_;
  ImplicitVelocity implicit_;
  MassiveMarkers *masses_ = nullptr;
  GapSlip *gaps_ = nullptr;
  TractionFilter *filter_ = nullptr;
  ViscosityContrast *contrast_ = nullptr;
  std::shared_ptr<CollectiveStop> stop_;
  rbc::Stopwatch exchanging_;
  std::shared_ptr<UnfinishedFlow> unfinished_;    ///< this, for the flow
  bool between_steps_ = false, is_read_within_ = false;
  bool viscosity_is_behind_ = false;    ///< that of the grid is of an earlier evaluation
  bool layers_are_missing_ = false;     ///< from the flow: those of cells that move as a whole
  bool surfaces_are_of_estimate_ = false;
  bool estimating_spectrum_ = false, any_speed_between_steps_ = false;
  int parts_ = 1;              ///< of the step
  rbc::Numbers applied_;       ///< a row for each atom here
  rbc::Numbers last_found_;    ///< velocities, empty before the first evaluation of a step

  double *rows(double **array) const;
  void find_surfaces();
  void solve_flow();
  void read_velocities(bool with_forces, const double *forces, double factor, double *velocity);
  void spread_layer();
  void evaluate(const rbc::Numbers &x, double fraction, Stage stage, rbc::Numbers &v);
  void report_too_fast(Stage stage);
  void report_crossing(int i, double multiple);
};

}    // namespace LAMMPS_NS

#endif
