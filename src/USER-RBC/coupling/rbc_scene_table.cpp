#include "coupling/rbc_scene_table.h"

#include "atom.h"
#include "cells/rbc_cell_contact.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "coupling/rbc_driven_flow.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "math_const.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "support/rbc_pair_parts.h"
#include "support/rbc_version.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

// mean edges of cells in fluid spacings: longer ones let fluid through, shorter ones move as one

static constexpr double SHORTEST_EDGE = 0.5, LONGEST_EDGE = 1.7;

// ranges of contact in fluid spacings

static constexpr double SHORTEST_RANGE = 1.0;

// Capillary number, and energy of adhesion per area over the shear modulus. A membrane of modulus G
// that bears a tension T in one direction is as long as (T / G = 0.5 (l^2 - 1 / l^2)) l = 4.5 and
// 3.2 at rest times its length: further than the skeleton of a red blood cell can be drawn.

static constexpr double LARGEST_CAPILLARY_NUMBER = 10, LARGEST_ADHESION = 5;

// Viscosity in Pa s that liquids exceed, and bending modulus in J that membranes exceed.

static constexpr double LEAST_VISCOSITY = 1e-4, LEAST_BENDING = 1e-21;

// Thickness of cells in fluid spacings where the viscosity inside over that of the fluid is larger
// than this ratio.

static constexpr double LEAST_THICKNESS = 2.0, THIN_RATIO = 8.0;

// Distance of cells from a plate in fluid spacings. Fluid at rest at the plate holds back what
// repels a vertex that is nearer: it does not come off, or it comes off within a step.

static constexpr double NEAREST_PLATE = 0.2;

/// What one is, in units of a style of LAMMPS.
struct SIUnits {
  const char *style;
  double viscosity, energy;    ///< in Pa s and J
};

/// Null for styles that simulations of atoms have, and for lj.
static const SIUnits *si_units(const std::string &style)
{
  static constexpr SIUnits KNOWN[] = {
      {"si", 1, 1}, {"cgs", 0.1, 1e-7}, {"micro", 1e-3, 1e-15}, {"nano", 1e-3, 1e-21}};
  const auto found = std::find_if(std::begin(KNOWN), std::end(KNOWN),
                                  [&](const SIUnits &units) { return style == units.style; });
  return found == std::end(KNOWN) ? nullptr : found;
}

/* ---------------------------------------------------------------------- */

SceneTable::SceneTable(LAMMPS *lmp, std::string style) : Pointers(lmp), style_(std::move(style)) {}

/* ---------------------------------------------------------------------- */

void SceneTable::print(const DrivenFlow &flow)
{
  print_version();
  spacing_ = flow.smallest_spacing();
  shear_rate_ = shear_rate(flow);
  find_kinds(flow);
  if (kinds_.empty()) return;
  find_types();
  find_contacts();
  find_repelling();
  plate_distance_ = flow.settings().plates ? plate_distance() : HUGE_VAL;
  const std::string text = table(flow) + boundaries(flow);
  if (text == printed_) return;
  printed_ = text;
  if (comm->me != 0) return;
  utils::logmesg(lmp, text);
  if (!warns_) return;
  warn_of_edges();
  warn_of_insides(flow);
  warn_of_contacts();
  warn_of_units(flow);
  warn_of_plates(flow);
}

void SceneTable::print_version()
{
  if (comm->me == 0 && !version_printed_)
    utils::logmesg(lmp, fmt::format("USER-RBC version {}\n", rbc_version()));
  version_printed_ = true;
}

/* ----------------------------------------------------------------------
   Returns the larger of two shear rates: that of the plates against each other, and that of the
   fastest wall against the middle of the box along its shortest side.
------------------------------------------------------------------------- */

double SceneTable::shear_rate(const DrivenFlow &flow) const
{
  double rate = 0;
  if (flow.settings().plates) {
    const auto &[lower, upper] = flow.forcing().plates;
    rate = std::hypot(upper[0] - lower[0], upper[1] - lower[1]) / domain->prd[2];
  }
  const double half = 0.5 * *std::min_element(domain->prd, domain->prd + 3);
  return flow.walls() ? std::max(rate, flow.walls()->fastest() / half) : rate;
}

/* ----------------------------------------------------------------------
   Finds the kinds of cells. Their capillary number is the viscous stress over the tension that
   resists shear.
------------------------------------------------------------------------- */

void SceneTable::find_kinds(const DrivenFlow &flow)
{
  kinds_.clear();
  const double stress = flow.settings().equations.viscosity * shear_rate_ / force->ftm2v;
  for (CellMembranes *membranes : all_cell_membranes(lmp)) {
    const double count = static_cast<double>(membranes->local_cells().count());
    const double radius = std::cbrt(0.75 / MathConst::MY_PI * membranes->shape().volume);
    kinds_.push_back({membranes, count, stress * radius / membranes->shear_modulus(), {}});
  }
}

void SceneTable::find_types()
{
  const int n = atom->ntypes + 1;
  std::vector<int> has(kinds_.size() * n);
  for (std::size_t k = 0; k < kinds_.size(); ++k)
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & kinds_[k].membranes->groupbit()) has[k * n + atom->type[i]] = 1;
  MPI_Allreduce(MPI_IN_PLACE, has.data(), static_cast<int>(has.size()), MPI_INT, MPI_MAX, world);
  for (std::size_t k = 0; k < kinds_.size(); ++k)
    for (int type = 1; type < n; ++type)
      if (has[k * n + type] || kinds_[k].cells < 1) kinds_[k].types.push_back(type);
}

/* ---------------------------------------------------------------------- */

void SceneTable::find_contacts()
{
  apart_.clear();
  for (Kind &kind : kinds_) {
    kind.adhesion = adhesion(kind);
    bool any = false;
    for (const Kind &other : kinds_) {
      if (&other == &kind ? kind.cells < 2 : kind.cells * other.cells < 1) continue;
      const double range = contact_range(kind, other);
      kind.contact = any ? std::min(kind.contact, range) : range;
      any = true;
      if (range > 0 || &other < &kind) continue;
      std::string cells =
          fmt::format("the {:.0f} cells of f{}", kind.cells, kind.membranes->style().substr(1));
      if (&other != &kind)
        cells +=
            fmt::format(" and the {:.0f} of f{}", other.cells, other.membranes->style().substr(1));
      apart_.push_back(cells);
    }
  }
}

double SceneTable::contact_range(const Kind &one, const Kind &other) const
{
  double shortest = HUGE_VAL;
  for (int i : one.types)
    for (int j : other.types) shortest = std::min(shortest, contact_range(i, j));
  return std::isfinite(shortest) ? shortest : 0;
}

/* ----------------------------------------------------------------------
   Returns the distance at which cells of these types begin to act on each other. Pair styles of
   LAMMPS act between vertices, up to their cutoff.
------------------------------------------------------------------------- */

double SceneTable::contact_range(int itype, int jtype) const
{
  double range = 0;
  for (StepPart *part : pair_step_parts(force))
    if (auto *const contact = dynamic_cast<CellContact *>(part))
      range = std::max(range, contact->contact_range(itype, jtype));
  if (range > 0 || !force->pair || utils::strmatch(force->pair_style, "^zero") ||
      utils::strmatch(force->pair_style, "^rbc/"))
    return range;
  return std::sqrt(force->pair->cutsq[itype][jtype]);
}

double SceneTable::adhesion(const Kind &kind) const
{
  double largest = 0;
  for (StepPart *part : pair_step_parts(force))
    if (auto *const contact = dynamic_cast<CellContact *>(part))
      for (int i : kind.types)
        for (int j = 1; j <= atom->ntypes; ++j)
          largest = std::max(largest, contact->adhesion(i, j));
  return largest;
}

double SceneTable::cells() const
{
  double sum = 0;
  for (const Kind &kind : kinds_) sum += kind.cells;
  return sum;
}

/* ---------------------------------------------------------------------- */

void SceneTable::find_repelling()
{
  repelling_ = repelling_pairs();
  int of_cells = 0;
  for (const Kind &kind : kinds_) of_cells |= kind.membranes->groupbit();
  for (Fix *fix : modify->get_fix_list()) {
    if (!utils::strmatch(fix->style, "^wall/")) continue;
    constexpr int GROUP_ALL = 1;
    int any = cells() < 1 && (fix->groupbit & (of_cells | GROUP_ALL));
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & fix->groupbit) && (atom->mask[i] & of_cells)) any = 1;
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
    if (any)
      repelling_ += fmt::format("{}{} {}", repelling_.empty() ? "" : ", ", fix->style, fix->id);
  }
}

/// Pair styles that repel cells of some type from plates or walls, in words.
std::string SceneTable::repelling_pairs() const
{
  std::string pairs;
  for (StepPart *part : pair_step_parts(force)) {
    auto *const contact = dynamic_cast<CellContact *>(part);
    std::string boundaries;
    for (const Kind &kind : kinds_)
      for (int type : kind.types)
        if (contact && boundaries.empty()) boundaries = contact->repelling_boundaries(type);
    if (!boundaries.empty())
      pairs += fmt::format("{}pair rbc/jkr {}", pairs.empty() ? "" : ", ", boundaries);
  }
  return pairs;
}

/// Distance of the vertex that is nearest to a plate. Collective.
double SceneTable::plate_distance() const
{
  int of_cells = 0;
  for (const Kind &kind : kinds_) of_cells |= kind.membranes->groupbit();
  double least = HUGE_VAL;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & of_cells)
      least = std::min({least, atom->x[i][2] - domain->boxlo[2], domain->boxhi[2] - atom->x[i][2]});
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, world);
  return least;
}

/* ---------------------------------------------------------------------- */

std::string SceneTable::table(const DrivenFlow &flow) const
{
  const auto &n = flow.settings().cells;
  std::string text = fmt::format(
      "\nUSER-RBC scene: {} x {} x {} fluid cells, spacing {:.6g}, neighbor skin {:.3g} spacings, "
      "{} ghost layers\n"
      "                 number |  mean edge | longest edge | thickness | contact range | capillary "
      "number\n"
      "                        |             in fluid spacings\n",
      n[0], n[1], n[2], spacing_, neighbor->skin / spacing_, flow.ghost_layers());
  for (const Kind &kind : kinds_) {
    const rbc::SurfaceTemplate &shape = kind.membranes->shape();
    const std::string &style = kind.membranes->style();
    const std::string contact =
        kind.contact > 0 ? fmt::format("{:.3g}", kind.contact / spacing_) : "none";
    const std::string number =
        kind.capillary_number > 0 ? fmt::format("{:.3g}", kind.capillary_number) : "-";
    text += fmt::format("{:<14} {:8.0f} | {:10.3g} | {:12.3g} | {:9.3g} | {:>13} | {:>16}\n",
                        style.substr(style.rfind(' ') + 1), kind.cells, shape.mean_edge / spacing_,
                        shape.longest_edge / spacing_, kind.membranes->thickness() / spacing_,
                        contact, number);
  }
  return text;
}

std::string SceneTable::rate() const
{
  constexpr double PER_SECOND = 1e6;    // of one in units micro
  const std::string rate = fmt::format("{:.3g}", shear_rate_);
  if (!utils::strmatch(update->unit_style, "^micro$")) return rate;
  return rate + fmt::format(" ({:.6g} /s)", PER_SECOND * shear_rate_);
}

std::string SceneTable::boundaries(const DrivenFlow &flow) const
{
  std::string text;
  if (flow.settings().plates) text += "Plates: shear rate " + rate();
  if (flow.walls()) text += (text.empty() ? "Walls: " : "; walls: ") + flow.walls()->names();
  if (text.empty()) return text;
  return text + (repelling_.empty() ? "; no fix wall repels cells from them\n"
                                    : "; cells are repelled by " + repelling_ + "\n");
}

/* ---------------------------------------------------------------------- */

void SceneTable::warn_of_edges() const
{
  for (const Kind &kind : kinds_) {
    const double edge = kind.membranes->shape().mean_edge / spacing_;
    if (kind.cells < 1 || (edge >= SHORTEST_EDGE && edge <= LONGEST_EDGE)) continue;
    error->warning(FLERR,
                   "{}: edges of the cells of f{} are {:.3g} fluid spacings long on average, and "
                   "{} to {} are resolved: use a {} vertices",
                   style_, kind.membranes->style().substr(1), edge, SHORTEST_EDGE, LONGEST_EDGE,
                   edge > LONGEST_EDGE ? "larger dx or a template with more"
                                       : "smaller dx or a template with fewer");
  }
}

void SceneTable::warn_of_insides(const DrivenFlow &flow) const
{
  const double outside = flow.settings().equations.viscosity;
  for (const Kind &kind : kinds_) {
    const double thickness = kind.membranes->thickness() / spacing_;
    if (kind.cells < 1 || thickness >= LEAST_THICKNESS || !kind.membranes->differs_inside(outside))
      continue;
    const double ratio = kind.membranes->interior_viscosity() / outside;
    if (ratio <= THIN_RATIO) continue;
    error->warning(FLERR,
                   "{}: cells of f{} are {:.3g} fluid spacings thick, and below {} an inside that "
                   "is {:.3g} times as viscous as the fluid is not resolved: use dx {:.3g}",
                   style_, kind.membranes->style().substr(1), thickness, LEAST_THICKNESS, ratio,
                   kind.membranes->thickness() / LEAST_THICKNESS);
  }
}

void SceneTable::warn_of_contacts() const
{
  for (const std::string &kinds : apart_)
    error->warning(
        FLERR,
        "{}: nothing keeps {} from passing through each other; use pair_style rbc/jkr, or "
        "include potentials/dense.blood",
        style_, kinds);
  for (const Kind &kind : kinds_) {
    const double range = kind.contact / spacing_;
    if (range == 0 || range >= SHORTEST_RANGE) continue;
    error->warning(FLERR,
                   "{}: cells of f{} repel each other from {:.3g} fluid spacings on; below {} the "
                   "fluid between them is not resolved: increase R of pair_coeff (variable range "
                   "before dense.blood), or use a smaller dx",
                   style_, kind.membranes->style().substr(1), range, SHORTEST_RANGE);
  }
}

/// Warns of numbers that look as if they were given in other units.
void SceneTable::warn_of_units(const DrivenFlow &flow) const
{
  const bool micro = utils::strmatch(update->unit_style, "^micro$");
  if (const SIUnits *const si = si_units(update->unit_style)) {
    const double viscosity = flow.settings().equations.viscosity * si->viscosity;
    if (viscosity < LEAST_VISCOSITY)
      error->warning(FLERR,
                     "{}: the viscosity of the fluid is {:.3g} Pa s, and no liquid has less than "
                     "{}: check its units{}",
                     style_, viscosity, LEAST_VISCOSITY,
                     micro ? " (in units micro it is in mPa s: that of plasma is 1.2)" : "");
    for (const Kind &kind : kinds_) {
      const double bending = kind.membranes->parameters().bending * si->energy;
      if (bending > 0 && bending < LEAST_BENDING)
        error->warning(FLERR,
                       "{}: the bending modulus of the cells of f{} is {:.3g} J, and below {}, a "
                       "quarter of the thermal energy, it resists nothing: check its units{}",
                       style_, kind.membranes->style().substr(1), bending, LEAST_BENDING,
                       micro ? " (in units micro it is in 1e-15 J: that of healthy cells is 2e-4)"
                             : "");
    }
  }
  for (const Kind &kind : kinds_) {
    const std::string cells = "the cells of f" + kind.membranes->style().substr(1);
    if (kind.capillary_number > LARGEST_CAPILLARY_NUMBER)
      error->warning(FLERR,
                     "{}: the capillary number of {} is {:.3g}, and above {} they are drawn to "
                     "several times their length: check the units of the shear rate {:.3g}{}",
                     style_, cells, kind.capillary_number, LARGEST_CAPILLARY_NUMBER, shear_rate_,
                     micro ? " (in units micro it is per us: 50 /s is 50e-6)" : "");
    const double over_modulus = kind.adhesion / kind.membranes->shear_modulus();
    if (over_modulus > LARGEST_ADHESION)
      error->warning(FLERR,
                     "{}: the adhesion {:.3g} of {} is {:.3g} times their shear modulus, and above "
                     "{} it tears at their membranes: check its units{}",
                     style_, kind.adhesion, cells, over_modulus, LARGEST_ADHESION,
                     micro ? " (in units micro it is in mJ/m^2: 0.2 uJ/m^2 is 2e-4)" : "");
  }
}

void SceneTable::warn_of_plates(const DrivenFlow &flow) const
{
  if (!flow.settings().plates || cells() < 2) return;
  if (repelling_.empty())
    error->warning(FLERR,
                   "{}: nothing repels the {:.0f} cells from the plates; use plates yes of "
                   "pair_style rbc/jkr, or include potentials/dense.blood",
                   style_, cells());
  const double distance = plate_distance_ / spacing_;
  if (distance < NEAREST_PLATE)
    error->warning(FLERR,
                   "{}: a cell is {:.2g} fluid spacings from a plate; nearer than {} it may be "
                   "pushed through, or thrown off by what repels it: let the region in which "
                   "rbc/create packs cells end off the plates",
                   style_, distance, NEAREST_PLATE);
}
