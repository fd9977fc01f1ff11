#ifndef LMP_RBC_IMPLICIT_VISCOSITY_H
#define LMP_RBC_IMPLICIT_VISCOSITY_H

#include "coupling/rbc_evaluation_stage.h"
#include "lmptype.h"
#include "motion/gmres.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class CellMembranes;
class DrivenFlow;
class ImmersedMarkers;

/// Solves for the velocities of markers in viscous membranes: they depend on viscous forces, which
/// depend on these velocities. The forces F of the atoms were computed with old velocities v. The
/// new velocities V obey (1 + M Z) V = M (F + Z v) + U. Here Z turns velocities into viscous forces
/// -Z V of the membranes, M turns forces on the markers into their velocities, and U is the
/// velocity caused by everything else. One round solves this linear system by GMRES and then
/// evaluates the flow with the corrected forces. One round is enough unless the viscosity depends
/// on the rate (then Z depends on V, and the rounds are those of Newton's method) or there are
/// rigid walls (which M leaves out). A round that does not halve the error is followed by one that
/// takes the viscosity of the present velocities as constant; such a round always lowers the error
/// (Kacanov's method).
class ImplicitViscosity : protected Pointers {
 public:
  ImplicitViscosity(LAMMPS *lmp, ImmersedMarkers &markers) : Pointers(lmp), markers_(markers) {}

  /// `tolerance`: root mean square error allowed in the velocities, relative to the fastest marker.
  /// `max_iterations`: of GMRES in each linear solve.
  void set_limits(double tolerance, int max_iterations);

  /// At the start of a run.
  void start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes);

  bool has_viscous_membranes() const { return !viscous_.empty(); }

  /// What it leaves undone of the velocities, relative to them; 0 without viscosity.
  double tolerance() const { return viscous_.empty() ? 0 : tolerance_; }

  /// Collective: velocities from the forces and velocities that the atoms hold. An evaluation of
  /// the flow in each round.
  void solve(EvaluationStage stage);

  /// Evaluations that did not reach the tolerance in this run.
  bigint unconverged() const { return unconverged_; }
  void reset_counts() { unconverged_ = 0; }

  std::size_t bytes() const;

 private:
  ImmersedMarkers &markers_;
  DrivenFlow *flow_ = nullptr;
  std::vector<CellMembranes *> viscous_;
  double tolerance_ = 1e-4;
  rbc::Gmres gmres_;
  bigint unconverged_ = 0;

  rbc::Numbers guess_, forces_, residual_, correction_;
  rbc::Numbers response_;    ///< a row for each atom here

  bool needs_rounds() const;
  double find_residual();
  double solve_linear(double tolerance);
  void viscous_response(const rbc::Numbers &p, rbc::Numbers &v);
  void correct_forces();
};

}    // namespace LAMMPS_NS

#endif
