#include "coupling/rbc_gap_slip.h"

#include "atom.h"
#include "cells/rbc_cell_contact.h"
#include "cells/rbc_cell_membranes.h"
#include "coupling/rbc_driven_flow.h"
#include "domain.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::dot, rbc::PlainVector;

static PlainVector vector(const double *row)
{
  return {row[0], row[1], row[2]};
}

static void add_to_row(double *row, const PlainVector &added)
{
  row[0] += added.x;
  row[1] += added.y;
  row[2] += added.z;
}

/* ---------------------------------------------------------------------- */

GapSlip::GapSlip(LAMMPS *lmp, RowExchange &exchange, fluid::KernelKind kernel) :
    Pointers(lmp), exchange_(exchange), kernel_(kernel), traction_(exchange.work(0)),
    slip_(exchange.work(1))
{
}

const fluid::GapMobility &GapSlip::missing()
{
  if (!missing_) missing_ = std::make_unique<fluid::GapMobility>(kernel_);
  return *missing_;
}

double GapSlip::widest_gap(const DrivenFlow &flow)
{
  return missing().range() * flow.mean_spacing();
}

void GapSlip::start_run(const DrivenFlow &flow, const std::vector<CellMembranes *> &membranes,
                        const CellContact *contact)
{
  contact_ = contact;
  membranes_ = membranes;
  const fluid::Grid &grid = flow.flow().grid();
  spacing_ = flow.mean_spacing();
  height_ = grid.spacing[2];
  viscosity_ = flow.settings().equations.viscosity;
  const auto holds = [&grid](fluid::PlateCondition condition) {
    return grid.plates && condition == fluid::PlateCondition::no_slip;
  };
  plates_[0] = {holds(grid.plate_conditions.lower), domain->boxlo[2]};
  plates_[1] = {holds(grid.plate_conditions.upper), domain->boxhi[2]};
  if (acts()) missing();
}

void GapSlip::atoms_migrated()
{
  area_.assign(atom->nlocal, 0.0);
  for (const CellMembranes *membranes : membranes_)
    for (const LocalCells::Cell &cell : membranes->local_cells().cells())
      for (int v = 0; v < membranes->shape().vertex_count(); ++v)
        if (cell.atom[v] >= 0 && cell.atom[v] < atom->nlocal)
          area_[cell.atom[v]] = membranes->shape().vertex_area[v];
}

/* ---------------------------------------------------------------------- */

void GapSlip::add(const std::vector<int> &members, const double *force, double factor,
                  double *velocity)
{
  stopwatch_.start();
  if (contact_) {
    set_tractions(members, force, factor);
    exchange_.send_to_ghosts(traction_);
    slide_near_surfaces();
    exchange_.add_from_ghosts(slip_);
    for (int i : members)
      if (area_[i] > 0)
        for (int d = 0; d < 3; ++d) velocity[3 * std::size_t(i) + d] += slip_[i][d] / area_[i];
  }
  slide_along_plates(members, force, factor, velocity);
  stopwatch_.stop();
}

void GapSlip::set_tractions(const std::vector<int> &members, const double *force, double factor)
{
  traction_.assign(atom->nlocal + atom->nghost);
  for (int i : members)
    if (area_[i] > 0)
      for (int d = 0; d < 3; ++d)
        traction_[i][d] = factor / area_[i] * force[3 * std::size_t(i) + d];
}

/* ----------------------------------------------------------------------
   A cell sees itself through its inside, where gaps count as negative. Cells that overlap have no
   fluid between them.
------------------------------------------------------------------------- */

void GapSlip::slide_near_surfaces()
{
  slip_.assign(atom->nlocal + atom->nghost);
  for (const auto &contact : contact_->near_contacts()) {
    const bool own = atom->molecule[contact.point] == atom->molecule[contact.corner[0]];
    const double gap = (own ? std::abs(contact.gap) : contact.gap) / spacing_;
    if (gap <= 0 || gap >= missing_->range()) continue;
    if (own && gap * spacing_ >= contact_->own_gap()) continue;
    slide(contact, missing_->slide(gap) * spacing_);
  }
}

void GapSlip::slide(const rbc::VertexContact &contact, double missing)
{
  PlainVector difference = vector(traction_[contact.point]);
  for (int c = 0; c < 3; ++c)
    difference = difference - contact.weight[c] * vector(traction_[contact.corner[c]]);
  const PlainVector along = difference - dot(contact.normal, difference) * contact.normal;
  const PlainVector slip = area_[contact.point] * missing / (8 * viscosity_) * along;
  add_to_row(slip_[contact.point], slip);
  for (int c = 0; c < 3; ++c) add_to_row(slip_[contact.corner[c]], -contact.weight[c] * slip);
}

/* ---------------------------------------------------------------------- */

void GapSlip::slide_along_plates(const std::vector<int> &members, const double *force,
                                 double factor, double *velocity) const
{
  for (const Plate &plate : plates_) {
    if (!plate.holds) continue;
    const double range = missing_->plate_range() * height_;
    for (int i : members) {
      const double gap = std::abs(atom->x[i][2] - plate.z);
      if (gap >= range || area_[i] == 0) continue;
      const double missing = missing_->slide_at_plate(gap / height_) * height_;
      const double mobility = factor * missing / (viscosity_ * area_[i]);
      for (int d = 0; d < 2; ++d) {
        const std::size_t number = 3 * std::size_t(i) + d;
        velocity[number] += mobility * force[number];
      }
    }
  }
}

/* ---------------------------------------------------------------------- */

std::size_t GapSlip::bytes() const
{
  return area_.capacity() * sizeof(double);
}
