#include "cells/rbc_boundary_contact.h"

#include "atom.h"
#include "cells/rbc_near_surfaces.h"
#include "domain.h"
#include "error.h"
#include "region.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;
using rbc::PlainVector;

/* ---------------------------------------------------------------------- */

BoundaryContact::BoundaryContact(LAMMPS *lmp, std::string style) :
    Pointers(lmp), style_(std::move(style))
{
}

void BoundaryContact::init(bool plates, const std::string &region)
{
  plates_ = plates;
  region_id_ = region;
  region_ = region.empty() ? nullptr : domain->get_region_by_id(region);
  if (!region.empty() && !region_)
    error->all(FLERR, "{} walls: there is no region with ID {}", style_, region);
  laws_.assign(atom->ntypes + 1, {});
}

void BoundaryContact::set_law(int itype, const std::optional<rbc::ContactLaw> &law)
{
  if (law)
    laws_[itype].emplace(*law);
  else
    laws_[itype].reset();
}

double BoundaryContact::range(int itype) const
{
  return laws_[itype] ? laws_[itype]->range() : 0;
}

std::string BoundaryContact::names() const
{
  const std::string walls = region_ ? "walls " + region_id_ : "";
  if (!plates_) return walls;
  return walls.empty() ? "plates" : "plates, " + walls;
}

/* ---------------------------------------------------------------------- */

void BoundaryContact::build(const NearSurfaces &surfaces, double range, double slack)
{
  candidates_.clear();
  prepare_region();
  const bool region_moves = region_ && region_->dynamic_check();
  for (int i = 0; i < atom->nlocal; ++i)
    if (laws_[atom->type[i]] && surfaces.is_vertex(i) &&
        (region_moves || can_touch(i, range + slack / 2)))
      candidates_.push_back({i, surfaces.area(i)});
  contacts_.reserve(2 * candidates_.size());
}

bool BoundaryContact::can_touch(int i, double range) const
{
  const double *const x = atom->x[i];
  if (plates_ && plate_gap(x) < range) return true;
  if (!region_) return false;
  const NearRegion near = near_region(x, range);
  return !near.inside || near.count > 0;
}

/// Distance from the nearer plate.
double BoundaryContact::plate_gap(const double *x) const
{
  return std::min(x[2] - domain->boxlo[2], domain->boxhi[2] - x[2]);
}

/// Where and how a region is that moves or changes its shape.
void BoundaryContact::prepare_region() const
{
  if (region_ && region_->dynamic_check()) region_->prematch();
}

/* ----------------------------------------------------------------------
   Regions of LAMMPS know the surface from the side on which their points are. They give that of the
   other side while they are inverted.
------------------------------------------------------------------------- */

BoundaryContact::NearRegion BoundaryContact::near_region(const double *x, double distance) const
{
  double y[3] = {x[0], x[1], x[2]};
  domain->remap(y);
  const bool inside = region_->match(y[0], y[1], y[2]);
  if (!inside) region_->interior ^= 1;
  const int count = region_->surface(y[0], y[1], y[2], distance);
  if (!inside) region_->interior ^= 1;
  return {inside, count};
}

/* ---------------------------------------------------------------------- */

const std::vector<BoundaryContact::Contact> &BoundaryContact::contacts(CollectiveStop &stop)
{
  contacts_.clear();
  prepare_region();
  for (const Candidate &candidate : candidates_) {
    const rbc::RepulsivePart &law = *laws_[atom->type[candidate.vertex]];
    if (plates_) touch_plates(candidate, law);
    if (region_) touch_walls(candidate, law, stop);
  }
  return contacts_;
}

void BoundaryContact::touch(const Candidate &candidate, const rbc::RepulsivePart &law,
                            const PlainVector &normal, double gap)
{
  if (gap >= law.range()) return;
  const auto [traction, energy] = law.at(gap);
  contacts_.push_back(
      {candidate.vertex, normal, gap, candidate.area * traction, candidate.area * energy});
}

void BoundaryContact::touch_plates(const Candidate &candidate, const rbc::RepulsivePart &law)
{
  const double z = atom->x[candidate.vertex][2];
  touch(candidate, law, {0, 0, 1}, z - domain->boxlo[2]);
  touch(candidate, law, {0, 0, -1}, domain->boxhi[2] - z);
}

/* ----------------------------------------------------------------------
   each part of the surface that the region tells of acts, as on an atom of fix wall/region
------------------------------------------------------------------------- */

void BoundaryContact::touch_walls(const Candidate &candidate, const rbc::RepulsivePart &law,
                                  CollectiveStop &stop)
{
  const int i = candidate.vertex;
  const auto [inside, count] = near_region(atom->x[i], law.range());
  bool lost = !inside && count == 0;
  for (int n = 0; n < count; ++n) {
    const Region::Contact &near = region_->contact[n];
    if (near.r > 0) {
      const double side = inside ? 1 : -1;
      touch(candidate, law, side / near.r * PlainVector{near.delx, near.dely, near.delz},
            side * near.r);
    } else
      lost = true;    // on the surface itself there is no direction
  }
  if (lost) report_beyond_walls(i, stop);
}

void BoundaryContact::report_beyond_walls(int i, CollectiveStop &stop) const
{
  const double *const x = atom->x[i];
  stop.report(fmt::format("{} walls: a vertex of the cell with molecule ID {} is not inside region "
                          "{}, at ({:.6g}, {:.6g}, {:.6g}) at step {}",
                          style_, atom->molecule[i], region_id_, x[0], x[1], x[2],
                          update->ntimestep),
              Flaw::through_plate);
}

/* ---------------------------------------------------------------------- */

double BoundaryContact::bytes() const
{
  return candidates_.capacity() * sizeof(Candidate) + contacts_.capacity() * sizeof(Contact) +
         laws_.capacity() * sizeof(laws_[0]);
}
