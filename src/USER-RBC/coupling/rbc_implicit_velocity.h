#ifndef LMP_RBC_IMPLICIT_VELOCITY_H
#define LMP_RBC_IMPLICIT_VELOCITY_H

#include "coupling/rbc_evaluation_stage.h"
#include "lmptype.h"
#include "motion/gmres.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class CellMembranes;
class DrivenFlow;
class ImmersedMarkers;
class ViscosityContrast;

/// Solves for the velocities of markers on which what drives them depends: the forces of viscous
/// membranes, and the flow where the fluid inside of cells has another viscosity. The forces F of
/// the atoms were computed with old velocities v. The new velocities V obey
///   (1 - D + M Z) V = M (F + Z v) + U.
/// Here Z turns velocities into viscous forces -Z V of the membranes, M turns forces on the markers
/// into their velocities, D velocities into those that their double layer adds, and U is the
/// velocity caused by everything else. One round solves this linear system by GMRES, and then
/// evaluates the flow with the velocities found; with double layers alone those are the result. One
/// round is enough unless the viscosity of membranes depends on the rate (then Z depends on V, and
/// the rounds are those of Newton's method) or there are rigid walls (which M and D leave out). A
/// round that does not halve the error is followed by one that takes the viscosity of the present
/// velocities as constant; such a round always lowers the error (Kacanov's method).
/// Where only double layers count, the solutions of the evaluations before precondition the next
/// ones. They are forgotten whenever neighbors are found, as at a restart.
class ImplicitVelocity : protected Pointers {
 public:
  ImplicitVelocity(LAMMPS *lmp, ImmersedMarkers &markers) : Pointers(lmp), markers_(markers) {}

  /// `tolerance`: root mean square error allowed in the velocities, relative to the fastest marker.
  /// `max_iterations`: of GMRES in each linear solve.
  void set_limits(double tolerance, int max_iterations);

  /// At the start of a run. `contrast` is null where all fluid has one viscosity.
  void start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes,
                 const ViscosityContrast *contrast);

  /// Atoms have other numbers here, or other equations are to be solved.
  void forget_directions() { kept_.forget(); }

  /// Whether anything depends on the velocities.
  bool acts() const { return contrast_ || !viscous_.empty(); }

  /// What it leaves undone of the velocities, relative to them; 0 where nothing depends on them.
  double tolerance() const { return acts() ? tolerance_ : 0; }

  /// Collective: velocities from the forces and velocities that the atoms hold. An evaluation of
  /// the flow in each round.
  void solve(EvaluationStage stage);

  /// On entry `change` is by how much a change of forces alters the velocities if membranes at rest
  /// are assumed. Solves for the change with the double layers of the moving membranes, but without
  /// their viscosity. See rbc::Motion::complete_change(). Collective.
  void complete_change(rbc::Numbers &change);

  /// Whether the flow is that of velocities other than those found last.
  bool flow_is_behind() const { return flow_is_behind_; }
  void flow_is_complete() { flow_is_behind_ = false; }

  /// Iterations of an evaluation in this run, and evaluations that did not reach the tolerance.
  double mean_iterations() const
  {
    return evaluations_ > 0 ? static_cast<double>(iterations_) / evaluations_ : 0;
  }
  bigint unconverged() const { return unconverged_; }
  void reset_counts() { evaluations_ = iterations_ = unconverged_ = 0; }

  /// Of the last evaluation: what is left, relative to the fastest marker.
  double error() const { return error_; }

  std::size_t bytes() const;

 private:
  ImmersedMarkers &markers_;
  DrivenFlow *flow_ = nullptr;
  std::vector<CellMembranes *> viscous_;
  const ViscosityContrast *contrast_ = nullptr;
  double tolerance_ = 1e-4;
  rbc::Gmres gmres_;
  rbc::KeptDirections kept_{4};
  bigint evaluations_ = 0, iterations_ = 0, unconverged_ = 0;
  double error_ = 0;
  bool flow_is_behind_ = false;

  rbc::Numbers guess_, forces_, residual_, correction_;
  rbc::Numbers response_;    ///< a row for each atom here

  bool needs_rounds() const;
  double find_residual();
  enum class Dependence { all, layers };
  double solve_linear(double tolerance, Dependence dependence);
  void response(const rbc::Numbers &p, Dependence dependence, rbc::Numbers &v);
  void correct_forces();
};

}    // namespace LAMMPS_NS

#endif
