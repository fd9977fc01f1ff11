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

/// Velocities of markers in membranes with viscosity. The forces F were computed with the
/// velocities v that the atoms had; the velocities V that are sought obey
///   (1 + M Z) V = M (F + Z v) + U,
/// with Z the resistance of the membranes, M the mobility of the markers and U the flow of all
/// else. Where Z depends on V this is Newton's method: Z is that of small changes of V, and what is
/// left goes into the next round. A round that gains little is followed by one with the viscosity
/// frozen, which always gains (Kacanov's method).
class ImplicitViscosity : protected Pointers {
 public:
  ImplicitViscosity(LAMMPS *lmp, ImmersedMarkers &markers) : Pointers(lmp), markers_(markers) {}

  /// Error allowed in the velocities, relative to the fastest marker, and iterations of a linear
  /// solve.
  void choose(double tolerance, int max_iterations);

  /// At the start of a run.
  void start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes);

  bool is_any() const { return !viscous_.empty(); }

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
  void resistance(const rbc::Numbers &p, rbc::Numbers &v);
  void correct_forces();
};

}    // namespace LAMMPS_NS

#endif
