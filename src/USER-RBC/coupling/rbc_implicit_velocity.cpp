#include "coupling/rbc_implicit_velocity.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "coupling/rbc_driven_flow.h"
#include "coupling/rbc_immersed_markers.h"

#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using rbc::Numbers;

// linear solves of an evaluation

static constexpr int MOST_ROUNDS = 20;

// Part of the tolerance that iterations reach, so that velocities found are within it when they are
// evaluated once more at the start of a run.

static constexpr double MARGIN = 0.9;

// error of a change of velocities in an estimate, relative to it

static constexpr double ESTIMATE_ERROR = 0.01;

/* ---------------------------------------------------------------------- */

void ImplicitVelocity::set_limits(double tolerance, int max_iterations)
{
  tolerance_ = tolerance;
  gmres_.max_iterations = max_iterations;
}

void ImplicitVelocity::start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes,
                                 const ViscosityContrast *contrast)
{
  flow_ = flow;
  contrast_ = contrast;
  flow_is_behind_ = false;
  kept_.forget();
  viscous_.clear();
  for (CellMembranes *cells : membranes)
    if (cells->is_viscous()) viscous_.push_back(cells);
}

/* ----------------------------------------------------------------------
   The linear system leaves out the walls and takes Z as constant. Where there are walls, or Z
   depends on the velocities, one linear solve does not suffice.
------------------------------------------------------------------------- */

bool ImplicitVelocity::needs_rounds() const
{
  bool rounds = flow_->walls() != nullptr;
  for (const CellMembranes *cells : viscous_) rounds = rounds || cells->is_thinning();
  return rounds;
}

/* ---------------------------------------------------------------------- */

void ImplicitVelocity::solve(EvaluationStage stage)
{
  const bool rounds = needs_rounds();
  flow_is_behind_ = false;
  ++evaluations_;
  double count = static_cast<double>(markers_.members().size());
  markers_.sum(&count, 1);

  if (contrast_ && viscous_.empty()) markers_.constrain_volume(stage);
  markers_.load(atom->v, guess_);
  markers_.velocities_of_flow(stage);
  double length = 0;
  bool frozen = false;
  for (int round = 0;; ++round) {
    markers_.load(atom->f, forces_);
    const double before = length, scale = markers_.fastest() * std::sqrt(count),
                 allowed = tolerance_ * scale;
    length = find_residual();
    error_ = scale > 0 ? length / scale : 0;
    if (!(length > allowed) && (round > 0 || contrast_)) return;
    if (round == MOST_ROUNDS) break;
    frozen = round > 0 && !frozen && length > before / 2;

    markers_.store(guess_, atom->v);
    for (CellMembranes *cells : viscous_) cells->linearise(frozen);
    const double part = rounds ? 0.5 : contrast_ ? MARGIN : 1;
    const double left = solve_linear(part * allowed, Dependence::all);
    iterations_ += gmres_.iterations();
    correct_forces();
    markers_.store(guess_, atom->v);
    flow_is_behind_ = contrast_ && !rounds;
    if (flow_is_behind_)
      markers_.constrain_volume(stage);
    else
      markers_.velocities_of_flow(stage);
    if (rounds) continue;
    const double found = markers_.fastest() * std::sqrt(count);
    error_ = found > 0 ? left / found : 0;
    if (left <= tolerance_ * found) return;
    if (left > allowed) break;
    if (std::exchange(flow_is_behind_, false)) markers_.velocities_of_flow(stage);
  }
  ++unconverged_;
}

/* ----------------------------------------------------------------------
   Stores in residual_ the velocities that the flow gave less those guessed, and returns the length
   of this vector over all ranks.
------------------------------------------------------------------------- */

double ImplicitVelocity::find_residual()
{
  markers_.load(atom->v, residual_);
  for (std::size_t i = 0; i < guess_.size(); ++i) residual_[i] -= guess_[i];
  return std::sqrt(dot(markers_, residual_, residual_));
}

/// Earlier solutions help where only layers count. With viscous forces the equation is stiff: where
/// atoms have moved a little, they mislead the solver, which takes twice as many iterations.
double ImplicitVelocity::solve_linear(double tolerance, Dependence dependence)
{
  const bool helps = dependence == Dependence::layers || viscous_.empty();
  correction_.assign(residual_.size(), 0.0);
  return gmres_.solve(
      [this, dependence](const Numbers &p, Numbers &result) {
        response(p, dependence, result);
        for (std::size_t i = 0; i < p.size(); ++i) result[i] += p[i];
      },
      markers_, residual_, tolerance, correction_, helps ? &kept_ : nullptr);
}

void ImplicitVelocity::complete_change(Numbers &change)
{
  if (!contrast_) return;
  residual_ = change;
  solve_linear(ESTIMATE_ERROR * std::sqrt(dot(markers_, change, change)), Dependence::layers);
  change = correction_;
}

/* ----------------------------------------------------------------------
   Computes v = (M Z - D) p: minus the velocities that viscous forces of the membranes and double
   layers cause if the atoms move with p; with layers alone, -D p. Overwrites atom->v and atom->f.
   Costs one solve of the flow.
------------------------------------------------------------------------- */

void ImplicitVelocity::response(const Numbers &p, Dependence dependence, Numbers &v)
{
  const bool viscous = dependence == Dependence::all && !viscous_.empty();
  v.assign(p.size(), 0.0);
  markers_.store(p, atom->v);
  if (viscous) {
    markers_.store(v, atom->f);
    for (CellMembranes *cells : viscous_) cells->add_viscous_change();
  }
  markers_.apply_mobility(viscous, response_);
  const std::vector<int> &members = markers_.members();
  for (std::size_t n = 0; n < members.size(); ++n)
    for (int d = 0; d < 3; ++d) v[3 * n + d] = -response_[3 * std::size_t(members[n]) + d];
  if (!contrast_) return;
  markers_.store(v, atom->v);
  markers_.remove_volume_change();
  markers_.load(atom->v, v);
}

/* ----------------------------------------------------------------------
   Adds the correction to guess_, and the change of the viscous forces that it causes to atom->f.
   Where the viscosity is constant, this change is the viscous force of the correction. Where it
   thins, it is the force at the new guess less that at the old one.
------------------------------------------------------------------------- */

void ImplicitVelocity::correct_forces()
{
  markers_.store(forces_, atom->f);
  for (CellMembranes *cells : viscous_) {
    if (cells->is_thinning()) {
      markers_.store(guess_, atom->v);
      cells->add_viscous_forces(true, -1);
    }
  }
  for (std::size_t i = 0; i < guess_.size(); ++i) guess_[i] += correction_[i];
  for (CellMembranes *cells : viscous_) {
    markers_.store(cells->is_thinning() ? guess_ : correction_, atom->v);
    cells->add_viscous_forces(true);
  }
}

/* ---------------------------------------------------------------------- */

std::size_t ImplicitVelocity::bytes() const
{
  std::size_t numbers = 0;
  for (const Numbers *vector : {&guess_, &forces_, &residual_, &correction_, &response_})
    numbers += vector->capacity();
  return gmres_.bytes() + kept_.bytes() + numbers * sizeof(double);
}
