#include "coupling/rbc_immersed_markers.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "coupling/rbc_driven_flow.h"
#include "domain.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::Numbers;

// What may be wrong with markers, and how it is reported.

/* ---------------------------------------------------------------------- */

bool ImmersedMarkers::is_nearly_folded() const
{
  int nearly = 0;
  for (const CellMembranes *cells : membranes_) nearly |= cells->is_nearly_folded() ? 1 : 0;
  if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, &nearly, 1, MPI_INT, MPI_MAX, world);
  return nearly != 0;
}

/* ----------------------------------------------------------------------
   LAMMPS would delete an atom beyond a plate when atoms migrate; this finds it before.
------------------------------------------------------------------------- */

void ImmersedMarkers::check_positions()
{
  if (domain->zperiodic) return;
  double **const x = atom->x;
  for (int i : members_)
    if (!(x[i][2] >= domain->boxlo[2] && x[i][2] < domain->boxhi[2]))
      return report(i, "went through a plate", Flaw::through_plate);
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::check_displacements(const Numbers &start, const Numbers &end)
{
  const double furthest = settings_.courant * flow_->smallest_spacing();
  for (std::size_t n = 0; n < members_.size(); ++n) {
    double square = 0;
    for (int d = 0; d < 3; ++d) square += std::pow(end[3 * n + d] - start[3 * n + d], 2);
    if (square <= furthest * furthest) continue;
    return report_crossing(members_[n], std::sqrt(square) / furthest);
  }
}

/* ---------------------------------------------------------------------- */

double ImmersedMarkers::fastest() const
{
  double fastest2 = 0;
  for (int i : members_) {
    const double *const v = atom->v[i];
    fastest2 = std::max(fastest2, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  MPI_Allreduce(MPI_IN_PLACE, &fastest2, 1, MPI_DOUBLE, MPI_MAX, world);
  return std::sqrt(fastest2);
}

double ImmersedMarkers::longest_step() const
{
  return 0.5 * settings_.courant * flow_->smallest_spacing() / fastest();
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::check_velocities(Stage stage)
{
  report_too_fast(stage);
  stop_->check();
}

void ImmersedMarkers::report_too_fast(Stage stage)
{
  const bool any_speed =
      estimating_spectrum_ || (any_speed_between_steps_ && stage != Stage::within);
  const double fastest = settings_.courant * flow_->smallest_spacing() * parts_ / update->dt;
  double **const v = atom->v;
  for (int i : members_) {
    const double speed2 = v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2];
    if (std::isfinite(speed2) && (any_speed || speed2 <= fastest * fastest)) continue;
    if (std::isfinite(speed2)) return report_crossing(i, std::sqrt(speed2) / fastest);
    return report(i, "has a velocity that is not a number", Flaw::not_finite);
  }
}

/* ----------------------------------------------------------------------
   a marker that crosses a multiple of what it may
------------------------------------------------------------------------- */

void ImmersedMarkers::report_crossing(int i, double multiple)
{
  report(i,
         fmt::format("would cross {:.3g} fluid cells in a step (CFL above {}; timestep too "
                     "large or unstable)",
                     settings_.courant * multiple, settings_.courant),
         Flaw::too_fast);
}

void ImmersedMarkers::report_outside(int i)
{
  report(i, "left the fluid its MPI task holds (reneighboring too rare, see neigh_modify)",
         Flaw::left_fluid);
}

void ImmersedMarkers::report(int i, const std::string &what, Flaw flaw)
{
  double **const x = atom->x;
  stop_->report(
      fmt::format(
          "{}: vertex with atom ID {} {} at step {}: molecule ID {} at ({:.6g}, {:.6g}, {:.6g})",
          style_, atom->tag[i], what, update->ntimestep,
          atom->molecule_flag ? atom->molecule[i] : 0, x[i][0], x[i][1], x[i][2]),
      flaw);
}
