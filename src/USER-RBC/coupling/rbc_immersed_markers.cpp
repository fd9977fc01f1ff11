#include "coupling/rbc_immersed_markers.h"

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "coupling/rbc_driven_flow.h"
#include "coupling/rbc_gap_slip.h"
#include "coupling/rbc_massive_markers.h"
#include "coupling/rbc_traction_filter.h"
#include "coupling/rbc_viscosity_contrast.h"
#include "dihedral.h"
#include "domain.h"
#include "force.h"
#include "geometry/tight_vector.h"
#include "improper.h"
#include "kspace.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

using namespace LAMMPS_NS;
using rbc::Numbers;

/* ---------------------------------------------------------------------- */

ImmersedMarkers::ImmersedMarkers(LAMMPS *lmp, std::string style, int groupbit,
                                 const Settings &settings) :
    Pointers(lmp),
    style_(std::move(style)), groupbit_(groupbit), settings_(settings), implicit_(lmp, *this),
    stop_(std::make_shared<CollectiveStop>(lmp)),
    unfinished_(static_cast<UnfinishedFlow *>(this), [](UnfinishedFlow *) {})
{
}

ImmersedMarkers::~ImmersedMarkers() = default;

void ImmersedMarkers::start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes,
                                fluid::MarkerKind kind, ViscosityContrast *contrast)
{
  flow_ = flow;
  kind_ = kind;
  membranes_ = membranes;
  volume_keepers_.clear();
  for (CellMembranes *cells : membranes)
    if (cells->keeps_volume()) volume_keepers_.push_back(cells);
  contrast_ = contrast;
  implicit_.start_run(flow, membranes, contrast);
  between_steps_ = is_read_within_ = viscosity_is_behind_ = layers_are_missing_ = false;
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::find_members()
{
  members_.clear();
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit_) members_.push_back(i);
}

bigint ImmersedMarkers::count() const
{
  bigint mine = static_cast<bigint>(members_.size()), all;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

fluid::MarkerSet ImmersedMarkers::set() const
{
  return {settings_.kernel, kind_, static_cast<int>(members_.size()), members_.data(),
          rows(atom->x)};
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::load(double **array, Numbers &numbers, int column) const
{
  rbc::resize_tightly(numbers, 3 * members_.size());
  for (std::size_t n = 0; n < members_.size(); ++n)
    for (int d = 0; d < 3; ++d) numbers[3 * n + d] = array[members_[n]][column + d];
}

void ImmersedMarkers::store(const Numbers &numbers, double **array, int column) const
{
  for (std::size_t n = 0; n < members_.size(); ++n)
    for (int d = 0; d < 3; ++d) array[members_[n]][column + d] = numbers[3 * n + d];
}

void ImmersedMarkers::sum(double *values, int count) const
{
  MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, world);
}

std::int64_t ImmersedMarkers::label(std::size_t point) const
{
  return atom->tag[members_[point]];
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::velocity(const Numbers &x, double fraction, Numbers &v)
{
  evaluate(x, fraction, Stage::within, v);
}

void ImmersedMarkers::velocity_at_end(const Numbers &x, Numbers &v)
{
  evaluate(x, 1, Stage::end, v);
}

/* ----------------------------------------------------------------------
   All velocities of an estimate are read alike, so that their differences are no noise.
------------------------------------------------------------------------- */

void ImmersedMarkers::estimate_spectrum(bool on)
{
  estimating_spectrum_ = on;
  surfaces_are_of_estimate_ = false;
  implicit_.forget_directions();
}

void ImmersedMarkers::evaluate(const Numbers &x, double fraction, Stage stage, Numbers &v)
{
  store(x, atom->x);
  // Membranes at rest exert no viscous forces: the estimate is then for elastic forces alone.
  if (estimating_spectrum_) std::fill(v.begin(), v.end(), 0.0);
  store(v, atom->v);
  check_positions();
  flow_->set_time(fraction);
  recompute_forces();
  velocities_from_forces(stage);
  load(atom->v, v);
  if (implicit_.acts() && !estimating_spectrum_) last_found_ = v;
}

void ImmersedMarkers::guess_velocities(Numbers &v) const
{
  if (!last_found_.empty()) v = last_found_;
}

/* ----------------------------------------------------------------------
   With inertia the atoms hold the velocities of the middle of the last step. Those at the start of
   this one could be interpolated from the fluid, but the Crank-Nicolson method lets the velocities
   at the ends of steps oscillate. So a step of the fluid is made, whose middle gives the
   velocities.
------------------------------------------------------------------------- */

void ImmersedMarkers::velocity_at_start(const Numbers & /*x*/, Numbers &v)
{
  if (!flow_->has_inertia()) return;
  flow_->set_time(0.5);
  velocities_from_forces(Stage::within);
  load(atom->v, v);
}

/* ----------------------------------------------------------------------
   A rank may own atoms of other groups alone: LAMMPS then has their rows, too.
------------------------------------------------------------------------- */

double *ImmersedMarkers::rows(double **array) const
{
  return atom->nlocal > 0 ? array[0] : nullptr;
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::velocities_from_forces(Stage stage)
{
  if (contrast_ && !surfaces_are_of_estimate_) find_surfaces();
  surfaces_are_of_estimate_ = estimating_spectrum_;
  if (implicit_.acts() && !estimating_spectrum_)
    implicit_.solve(stage);
  else
    velocities_of_flow(stage);
  viscosity_is_behind_ = contrast_;
  layers_are_missing_ = contrast_ && !estimating_spectrum_;
  if (contrast_) flow_->leave_unfinished(unfinished_);
  check_velocities(stage);
  flow_->finish_step();
}

void ImmersedMarkers::velocities_of_flow(Stage stage)
{
  if (masses_)
    masses_->couple(*this, *flow_);
  else {
    solve_flow();
    flow_->interpolate(set(), rows(atom->v));
    read_velocities(true, rows(atom->f), force->ftm2v, rows(atom->v));
  }
  constrain_volume(stage);
}

/* ----------------------------------------------------------------------
   Makes of the velocities that kernels see those with which vertices move. The forces times
   `factor` caused them, if there are any.
------------------------------------------------------------------------- */

void ImmersedMarkers::read_velocities(bool with_forces, const double *forces, double factor,
                                      double *velocity)
{
  if (contrast_) contrast_->take_off_wrong(set(), velocity);
  if (filter_) filter_->smooth_velocities(velocity);
  if (gaps_ && with_forces) gaps_->add(members_, forces, factor, velocity);
  if (contrast_) contrast_->read(set(), velocity);
}

void ImmersedMarkers::solve_flow()
{
  flow_->clear_force();
  const double factor = force->ftm2v;
  const int outside = filter_
                          ? flow_->spread(set(), filter_->smooth_forces(rows(atom->f), factor), 1)
                          : flow_->spread(set(), rows(atom->f), factor);
  if (outside >= 0) report_outside(outside);
  if (contrast_ && estimating_spectrum_) contrast_->leave_out_layer();
  if (contrast_ && !estimating_spectrum_) spread_layer();
  flow_->solve(*stop_, !estimating_spectrum_);
}

void ImmersedMarkers::find_surfaces()
{
  contrast_->find_surfaces();
  const int outside = contrast_->find_seen(set());
  if (outside >= 0) report_outside(outside);
  stop_->check();
}

void ImmersedMarkers::between_steps(bool yes)
{
  between_steps_ = yes;
  if (yes && is_read_within_) flow_->finish_evaluation();
}

void ImmersedMarkers::finish_velocity()
{
  if (!between_steps_) {
    is_read_within_ = true;
    return;
  }
  const bool behind = implicit_.flow_is_behind();
  if (!behind && !layers_are_missing_) return;
  if (!contrast_->knows_surfaces()) contrast_->find_surfaces();
  if (behind) {
    implicit_.flow_is_complete();
    solve_flow();
    layers_are_missing_ = true;
  }
  if (!std::exchange(layers_are_missing_, false)) return;
  const int outside = contrast_->add_rigid_layers(set());
  if (outside >= 0) report_outside(outside);
}

void ImmersedMarkers::finish_viscosity()
{
  if (!between_steps_) return;
  if (!std::exchange(viscosity_is_behind_, false)) return;
  if (!contrast_->knows_surfaces()) contrast_->find_surfaces();
  contrast_->find_excess(set());
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::spread_layer()
{
  const auto moving = contrast_->layer(set());
  const int outside = flow_->spread(set(), moving.layer, moving.mean_excess);
  if (outside >= 0) report_outside(outside);
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::interpolate()
{
  flow_->interpolate(set(), rows(atom->v));
  constrain_volume(Stage::start);
}

/* ----------------------------------------------------------------------
   With inertia a step has a single evaluation, in its middle: it counts as the first of a step, and
   volumes are those wanted in the middle.
------------------------------------------------------------------------- */

void ImmersedMarkers::constrain_volume(Stage stage)
{
  const bool inertia = flow_->has_inertia();
  for (CellMembranes *cells : volume_keepers_)
    cells->constrain_volume(update->dt, inertia || stage == Stage::start, inertia);
}

void ImmersedMarkers::remove_volume_change()
{
  for (CellMembranes *cells : volume_keepers_) cells->remove_volume_change();
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::apply_mobility(bool with_forces, Numbers &response)
{
  const std::size_t all = 3 * static_cast<std::size_t>(atom->nlocal);
  response.resize(all);
  const double *felt = nullptr;
  if (filter_ && !with_forces) filter_->leave_out_forces();
  if (with_forces) {
    applied_.resize(all);
    for (int i : members_)
      for (int d = 0; d < 3; ++d) applied_[3 * std::size_t(i) + d] = force->ftm2v * atom->f[i][d];
    felt = filter_ ? filter_->smooth_forces(applied_.data(), 1) : applied_.data();
  }
  int outside;
  if (contrast_) {
    const auto moving = contrast_->layer(set());
    outside = flow_->apply_mobility(set(), felt, response.data(), &moving.layer, moving.mean_excess,
                                    with_forces);
  } else
    outside = flow_->apply_mobility(set(), felt, response.data());
  if (outside >= 0) report_outside(outside);
  read_velocities(with_forces, applied_.data(), 1, response.data());
}

/* ---------------------------------------------------------------------- */

void ImmersedMarkers::recompute_forces()
{
  const bool before = std::exchange(between_steps_, false);
  exchanging_.start();
  comm->forward_comm();
  exchanging_.stop();

  const std::size_t count = atom->nlocal + (force->newton ? atom->nghost : 0);
  if (count) memset(atom->f[0], 0, 3 * count * sizeof(double));

  constexpr int eflag = 0, vflag = 0;
  if (modify->n_pre_force) modify->pre_force(vflag);
  if (force->pair && force->pair->compute_flag) force->pair->compute(eflag, vflag);
  if (atom->molecular != Atom::ATOMIC) {
    if (force->bond) force->bond->compute(eflag, vflag);
    if (force->angle) force->angle->compute(eflag, vflag);
    if (force->dihedral) force->dihedral->compute(eflag, vflag);
    if (force->improper) force->improper->compute(eflag, vflag);
  }
  if (force->kspace && force->kspace->compute_flag) force->kspace->compute(eflag, vflag);
  if (modify->n_pre_reverse) modify->pre_reverse(eflag, vflag);
  if (force->newton) comm->reverse_comm();
  if (modify->n_post_force_any) modify->post_force(vflag);
  between_steps_ = before;
}

/* ---------------------------------------------------------------------- */

std::size_t ImmersedMarkers::bytes() const
{
  return implicit_.bytes() + (applied_.capacity() + last_found_.capacity()) * sizeof(double) +
         members_.capacity() * sizeof(int);
}
