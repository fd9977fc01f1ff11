#include "support/rbc_remedies.h"

#include "fmt/format.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {

enum class Remedy {
  forces,
  dense,
  stages,
  adapt,
  timestep,
  overlap,
  crease,
  stretch,
  contact,
  mesh,
  grid,
  cutoff,
  skin,
  repel,
  firm
};

/// In the order in which they are likely to help.
std::vector<Remedy> against(Flaw flaw)
{
  switch (flaw) {
    case Flaw::too_fast:
    case Flaw::unstable:
      return {Remedy::stages,  Remedy::adapt,   Remedy::timestep,
              Remedy::overlap, Remedy::contact, Remedy::grid};
    case Flaw::not_finite:
      return {Remedy::stages, Remedy::adapt, Remedy::timestep, Remedy::overlap, Remedy::grid};
    case Flaw::folded:
      return {Remedy::dense, Remedy::crease,   Remedy::stretch, Remedy::contact, Remedy::stages,
              Remedy::adapt, Remedy::timestep, Remedy::mesh,    Remedy::grid};
    case Flaw::stretched:
      return {Remedy::dense,   Remedy::cutoff, Remedy::stretch,
              Remedy::contact, Remedy::adapt,  Remedy::mesh};
    case Flaw::left_fluid:
      return {Remedy::skin, Remedy::stages, Remedy::adapt, Remedy::timestep};
    case Flaw::through_plate:
      return {Remedy::repel, Remedy::stages, Remedy::adapt, Remedy::timestep};
    case Flaw::crossed:
      return {Remedy::firm, Remedy::stages, Remedy::adapt, Remedy::timestep, Remedy::mesh};
    case Flaw::unseen_motion:
      return {Remedy::skin, Remedy::adapt, Remedy::timestep};
    case Flaw::other:
      break;
  }
  return {};
}

bool applies(Remedy remedy, const Situation &now)
{
  switch (remedy) {
    case Remedy::dense:
      return now.several_cells && !(now.creases && now.limits_stretch);
    case Remedy::stages:
      return !now.inertia && !now.chooses_stages;
    case Remedy::adapt:
      return !now.inertia && !now.adapts;
    case Remedy::crease:
      return now.membranes && !now.creases;
    case Remedy::stretch:
      return now.membranes && !now.limits_stretch;
    case Remedy::forces:
      return !now.pushing.empty();
    case Remedy::overlap:
      return !now.pair_of_atoms.empty();
    case Remedy::contact:
      return now.lacks_contact;
    case Remedy::mesh:
      return now.membranes;
    case Remedy::grid:
      return now.finer_spacing > 0;
    default:
      return true;
  }
}

std::string text(Remedy remedy, const Situation &now)
{
  constexpr double MORE = 1.5;
  switch (remedy) {
    case Remedy::forces:
      return fmt::format("smaller forces of {}", now.pushing);
    case Remedy::dense:
      return "include potentials/dense.blood before run, which has what many cells need";
    case Remedy::stages:
      return "integrator rkc auto";
    case Remedy::adapt:
      return "adapt of fix rbc/ib";
    case Remedy::timestep:
      return fmt::format("a timestep shorter than {:.4g}", now.timestep);
    case Remedy::overlap:
      return fmt::format("atoms that do not overlap with others at the start (pair_style {})",
                         now.pair_of_atoms);
    case Remedy::crease:
      return "crease of fix rbc/membrane";
    case Remedy::stretch:
      return "stretch of fix rbc/membrane";
    case Remedy::contact:
      return "contact between cells (pair_style rbc/jkr)";
    case Remedy::mesh:
      return "a finer mesh of the cells";
    case Remedy::grid:
      return fmt::format(
          "dx {:.3g} of fix rbc/fluid, as cells with another viscosity inside should "
          "be two fluid cells thick",
          now.finer_spacing);
    case Remedy::cutoff:
      return fmt::format("comm_modify cutoff {:.3g}", MORE * now.ghost_cutoff);
    case Remedy::skin:
      return fmt::format("neighbor {:.3g} bin, and neigh_modify every 1 delay 0 check yes",
                         MORE * now.skin);
    case Remedy::repel:
      return "a force that holds cells off plates and walls (keywords of pair_style rbc/jkr); "
             "cells that start further from them";
    case Remedy::firm:
      return "a stronger repulsion of surfaces, or one of a longer range (pair_coeff of rbc/jkr)";
  }
  return {};
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::string LAMMPS_NS::remedies(const std::vector<Flaw> &seen, const Situation &situation)
{
  std::vector<Remedy> named;
  if (!seen.empty() && applies(Remedy::forces, situation)) named.push_back(Remedy::forces);
  for (Flaw flaw : seen)
    for (Remedy remedy : against(flaw))
      if (applies(remedy, situation) &&
          std::find(named.begin(), named.end(), remedy) == named.end())
        named.push_back(remedy);
  std::string list;
  for (Remedy remedy : named) list += (list.empty() ? "" : "; ") + text(remedy, situation);
  return list.empty() ? list : ". What may help, likeliest first: " + list;
}
