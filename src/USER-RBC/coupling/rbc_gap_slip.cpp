#include "coupling/rbc_gap_slip.h"

#include "atom.h"
#include "cells/rbc_cell_contact.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "coupling/rbc_driven_flow.h"
#include "domain.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::dot, rbc::PlainVector;

static PlainVector row(const double *rows, int i)
{
  return {rows[3 * std::size_t(i)], rows[3 * std::size_t(i) + 1], rows[3 * std::size_t(i) + 2]};
}

static void add_to_row(std::vector<double> &rows, int i, const PlainVector &added)
{
  double *const row = &rows[3 * std::size_t(i)];
  row[0] += added.x;
  row[1] += added.y;
  row[2] += added.z;
}

static double mean_spacing(const DrivenFlow &flow)
{
  const auto &h = flow.flow().grid().spacing;
  return std::cbrt(h[0] * h[1] * h[2]);
}

/* ---------------------------------------------------------------------- */

GapSlip::GapSlip(LAMMPS *lmp, Fix *owner, fluid::KernelKind kernel) :
    Pointers(lmp), owner_(owner), kernel_(kernel)
{
}

const fluid::GapMobility &GapSlip::missing()
{
  if (!missing_) missing_ = std::make_unique<fluid::GapMobility>(kernel_);
  return *missing_;
}

double GapSlip::widest_gap(const DrivenFlow &flow)
{
  return missing().range() * mean_spacing(flow);
}

void GapSlip::start_run(const DrivenFlow &flow, const std::vector<CellMembranes *> &membranes,
                        const CellContact *contact)
{
  contact_ = contact;
  membranes_ = membranes;
  const fluid::Grid &grid = flow.flow().grid();
  spacing_ = mean_spacing(flow);
  height_ = grid.spacing[2];
  viscosity_ = flow.settings().equations.viscosity;
  const auto holds = [&grid](fluid::PlateCondition condition) {
    return grid.plates && condition == fluid::PlateCondition::no_slip;
  };
  plates_[0] = {holds(grid.plate_conditions.lower), domain->boxlo[2]};
  plates_[1] = {holds(grid.plate_conditions.upper), domain->boxhi[2]};
  if (acts()) missing();
}

void GapSlip::find_areas()
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
    comm->forward_comm(owner_);
    slide_near_surfaces();
    comm->reverse_comm(owner_);
    for (int i : members)
      if (area_[i] > 0)
        for (int d = 0; d < 3; ++d)
          velocity[3 * std::size_t(i) + d] += slip_[3 * std::size_t(i) + d] / area_[i];
  }
  slide_along_plates(members, force, factor, velocity);
  stopwatch_.stop();
}

void GapSlip::set_tractions(const std::vector<int> &members, const double *force, double factor)
{
  traction_.assign(3 * std::size_t(atom->nlocal + atom->nghost), 0.0);
  for (int i : members)
    if (area_[i] > 0)
      for (int d = 0; d < 3; ++d)
        traction_[3 * std::size_t(i) + d] = factor / area_[i] * force[3 * std::size_t(i) + d];
}

/* ----------------------------------------------------------------------
   A cell sees itself through its inside, where gaps count as negative. Cells that overlap have no
   fluid between them.
------------------------------------------------------------------------- */

void GapSlip::slide_near_surfaces()
{
  slip_.assign(traction_.size(), 0.0);
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
  PlainVector difference = row(traction_.data(), contact.point);
  for (int c = 0; c < 3; ++c)
    difference = difference - contact.weight[c] * row(traction_.data(), contact.corner[c]);
  const PlainVector along = difference - dot(contact.normal, difference) * contact.normal;
  const PlainVector slip = area_[contact.point] * missing / (8 * viscosity_) * along;
  add_to_row(slip_, contact.point, slip);
  for (int c = 0; c < 3; ++c) add_to_row(slip_, contact.corner[c], -contact.weight[c] * slip);
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
      for (int d = 0; d < 2; ++d)
        velocity[3 * std::size_t(i) + d] += mobility * force[3 * std::size_t(i) + d];
    }
  }
}

/* ---------------------------------------------------------------------- */

int GapSlip::pack_tractions(int n, const int *list, double *buf) const
{
  for (int m = 0; m < n; ++m)
    std::copy_n(traction_.data() + 3 * std::size_t(list[m]), 3, buf + 3 * std::size_t(m));
  return 3 * n;
}

void GapSlip::unpack_tractions(int n, int first, const double *buf)
{
  std::copy_n(buf, 3 * std::size_t(n), traction_.data() + 3 * std::size_t(first));
}

int GapSlip::pack_slip(int n, int first, double *buf) const
{
  std::copy_n(slip_.data() + 3 * std::size_t(first), 3 * std::size_t(n), buf);
  return 3 * n;
}

void GapSlip::unpack_slip(int n, const int *list, const double *buf)
{
  for (int m = 0; m < n; ++m)
    for (int d = 0; d < 3; ++d) slip_[3 * std::size_t(list[m]) + d] += buf[3 * std::size_t(m) + d];
}

std::size_t GapSlip::bytes() const
{
  return (area_.capacity() + traction_.capacity() + slip_.capacity()) * sizeof(double);
}
