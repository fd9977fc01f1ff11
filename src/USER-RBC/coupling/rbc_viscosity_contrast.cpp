#include "coupling/rbc_viscosity_contrast.h"

#include "atom.h"
#include "cells/rbc_cell_contact.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "coupling/rbc_driven_flow.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// Part taken off of what vertices see across gaps: what they do see depends on the place on the
// grid, and to take off too much would let surfaces repel each other.

static constexpr double SEEN = 0.75;

/* ---------------------------------------------------------------------- */

bool ViscosityContrast::acts_on(const CellMembranes &cells) const
{
  return std::any_of(kinds_.begin(), kinds_.end(),
                     [&cells](const Kind &kind) { return kind.membranes == &cells; });
}

double ViscosityContrast::widest_gap(const DrivenFlow &flow, fluid::KernelKind kernel)
{
  if (!gaps_) gaps_ = std::make_unique<fluid::GapMobility>(kernel);
  return gaps_->share_range() * flow.mean_spacing();
}

void ViscosityContrast::start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes,
                                  fluid::KernelKind kernel, const CellContact *contact)
{
  flow_ = flow;
  contact_ = contact;
  kinds_.clear();
  motions_.clear();
  in_cells_ = 0;
  knows_surfaces_ = false;
  const double outside = flow->settings().equations.viscosity;
  for (CellMembranes *cells : membranes)
    if (cells->differs_inside(outside))
      kinds_.push_back({cells, cells->interior_viscosity() / outside - 1});
  if (!acts()) return;
  if (contact_) widest_gap(*flow_, kernel);
  for (CellMembranes *cells : membranes) {
    motions_.emplace_back(*cells);
    in_cells_ |= cells->groupbit();
  }
}

/* ---------------------------------------------------------------------- */

void ViscosityContrast::find_surfaces()
{
  stopwatch_.start();
  strength_.assign(3 * std::size_t(atom->nlocal), 0.0);
  place_.assign(3 * std::size_t(atom->nlocal), 0.0);
  for (const Kind &kind : kinds_)
    kind.membranes->visit_volume_gradients(
        [&](int i, const rbc::Vec3 &gradient, const rbc::Vec3 &place) {
          for (int d = 0; d < 3; ++d) {
            strength_[3 * std::size_t(i) + d] = kind.excess * gradient[d];
            place_[3 * std::size_t(i) + d] = place[d];
          }
        });
  for (RigidMotions &motions : motions_) motions.find_places(atom->x);
  knows_surfaces_ = true;
  stopwatch_.stop();
}

int ViscosityContrast::find_seen(const fluid::MarkerSet &markers)
{
  const double mean = total_excess() / flow_->box_volume();
  unit_.assign(strength_.size(), 1.0);
  part_.assign(strength_.size(), 1.0);
  const fluid::DoubleLayer unit{unit_.data(), strength_.data()};
  const int outside =
      flow_->apply_mobility(markers, nullptr, part_.data(), &unit, {mean, mean, mean}, false);
  for (int n = 0; n < markers.count; ++n)
    for (int d = 0; d < 3; ++d) {
      double &part = part_[3 * std::size_t(markers.index[n]) + d];
      part = atom->mask[markers.index[n]] & in_cells_ ? 1 / (1 + part) : 1;
    }
  if (contact_) find_what_remains();
  return outside;
}

void ViscosityContrast::find_excess(const fluid::MarkerSet &markers)
{
  std::array<double, 2> bounds{0, 0};
  for (const Kind &kind : kinds_) {
    bounds[0] = std::min(bounds[0], kind.excess);
    bounds[1] = std::max(bounds[1], kind.excess);
  }
  flow_->find_excess(markers, strength_.data(), total_excess() / flow_->box_volume(), bounds);
}

/* ----------------------------------------------------------------------
   integral of the excess over the cells: of their volumes by the divergence of the position
------------------------------------------------------------------------- */

double ViscosityContrast::total_excess() const
{
  double mine = 0, all;
  for (std::size_t n = 0; n < strength_.size(); ++n) mine += strength_[n] * place_[n] / 3;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   The integral of u over a cell is that of x (u . n) over its surface, as div u = 0.
------------------------------------------------------------------------- */

std::array<double, 3> ViscosityContrast::mean_excess(const fluid::MarkerSet &markers,
                                                     const double *velocity) const
{
  std::array<double, 3> mine{0, 0, 0}, all;
  for (int n = 0; n < markers.count; ++n) {
    const std::size_t row = 3 * std::size_t(markers.index[n]);
    double flux = 0;
    for (int d = 0; d < 3; ++d) flux += velocity[row + d] * strength_[row + d];
    for (int d = 0; d < 3; ++d) mine[d] += flux * place_[row + d] / flow_->box_volume();
  }
  MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ---------------------------------------------------------------------- */

ViscosityContrast::Moving ViscosityContrast::layer(const fluid::MarkerSet &markers)
{
  stopwatch_.start();
  wrong_.assign(strength_.size(), 0.0);
  const double *const velocity = atom->nlocal > 0 ? atom->v[0] : nullptr;
  relative_.assign(velocity, velocity + strength_.size());
  find_rigid(velocity, rigid_);
  for (std::size_t n = 0; n < relative_.size(); ++n) relative_[n] -= rigid_[n];

  // Atoms and their ghosts have these velocities for a while.
  exchange_with_atoms(relative_);
  if (contact_ || comm->nprocs > 1) comm->forward_comm_array(3, atom->v);
  add_blurred(markers.kernel);
  if (contact_) add_seen_across();
  exchange_with_atoms(relative_);
  if (contact_) {
    exchange_with_atoms(rigid_);
    comm->forward_comm_array(3, atom->v);
    add_wholes_across();
    exchange_with_atoms(rigid_);
  }

  const Moving moving{{relative_.data(), strength_.data()}, mean_excess(markers, relative_.data())};
  stopwatch_.stop();
  return moving;
}

void ViscosityContrast::leave_out_layer()
{
  for (auto *values : {&wrong_, &rigid_, &relative_}) values->assign(strength_.size(), 0.0);
}

void ViscosityContrast::find_rigid(const double *velocity, std::vector<double> &rigid)
{
  rigid.assign(strength_.size(), 0.0);
  for (RigidMotions &motions : motions_) motions.find(velocity, rigid.data());
}

void ViscosityContrast::exchange_with_atoms(std::vector<double> &velocity) const
{
  if (!velocity.empty()) std::swap_ranges(velocity.begin(), velocity.end(), atom->v[0]);
}

void ViscosityContrast::add_blurred(fluid::KernelKind kernel)
{
  const double offset = fluid::surface_offset(kernel) * flow_->mean_spacing();
  for (const Kind &kind : kinds_)
    kind.membranes->visit_surface_shear([&](int i, const rbc::Vec3 &shear) {
      for (int d = 0; d < 3; ++d) wrong_[3 * std::size_t(i) + d] += kind.excess * offset * shear[d];
    });
}

/* ----------------------------------------------------------------------
   Calls visit(contact, own, seen) for each vertex and surface near it, seen the excess of the
   viscosity behind that surface that the vertex sees, in the mean over places on the grid.
   A vertex that moves as the surface across the gap does sees w and the excess of the viscosity
   alike, and their ratio is right. A cell sees itself through its inside, where gaps count as
   negative: there it sees too little of its own layer.
------------------------------------------------------------------------- */

template <typename Visit> void ViscosityContrast::visit_seen(Visit visit) const
{
  const double spacing = flow_->mean_spacing();
  for (const rbc::VertexContact &contact : contact_->near_contacts()) {
    const double excess = excess_of(contact.corner[0]);
    const bool own = atom->molecule[contact.point] == atom->molecule[contact.corner[0]];
    const double gap = own ? std::abs(contact.gap) : contact.gap;
    if (excess == 0 || gap <= 0 || (own && gap >= contact_->own_gap())) continue;
    const double share = gaps_->share(gap / spacing);
    if (share != 0) visit(contact, own, own && contact.gap < 0 ? -excess * share : excess * share);
  }
}

/* ----------------------------------------------------------------------
   Velocity of the surface across the gap less that of the vertex, along d.
------------------------------------------------------------------------- */

double ViscosityContrast::across(const rbc::VertexContact &contact, int d) const
{
  double value = -atom->v[contact.point][d];
  for (int c = 0; c < 3; ++c) value += contact.weight[c] * atom->v[contact.corner[c]][d];
  return value;
}

void ViscosityContrast::add_seen_across()
{
  visit_seen([&](const rbc::VertexContact &contact, bool /*own*/, double seen) {
    for (int d = 0; d < 3; ++d)
      wrong_[3 * std::size_t(contact.point) + d] += SEEN * seen * across(contact, d);
  });
}

/* ----------------------------------------------------------------------
   The layers of cells as wholes are not there. What would remain seen of those of others is put in,
   so that near surfaces resist each other's motion whatever part of it is that of wholes.
------------------------------------------------------------------------- */

void ViscosityContrast::add_wholes_across()
{
  visit_seen([&](const rbc::VertexContact &contact, bool own, double seen) {
    if (own) return;
    for (int d = 0; d < 3; ++d) {
      const std::size_t row = 3 * std::size_t(contact.point) + d;
      wrong_[row] -= remains_[row] * seen * across(contact, d);
    }
  });
}

/* ----------------------------------------------------------------------
   Of what a vertex sees of other cells near it, over what it does in the mean over places on the
   grid: the part that is not taken off. Of its own cell it sees what the vertices do in the mean.
------------------------------------------------------------------------- */

void ViscosityContrast::find_what_remains()
{
  remains_.assign(strength_.size(), 0.0);
  visit_seen([&](const rbc::VertexContact &contact, bool own, double seen) {
    for (int d = 0; d < 3 && !own; ++d) remains_[3 * std::size_t(contact.point) + d] += seen;
  });
  left_.resize(strength_.size());
  for (std::size_t row = 0; row < left_.size(); ++row)
    left_[row] = 1 / part_[row] - 1 - remains_[row];
  find_rigid(left_.data(), rigid_);
  for (std::size_t row = 0; row < left_.size(); ++row)
    if (remains_[row] != 0)
      remains_[row] = std::max(0.0, (1 / part_[row] - 1 - rigid_[row]) / remains_[row] - SEEN);
}

/* ---------------------------------------------------------------------- */

double ViscosityContrast::excess_of(int i) const
{
  for (const Kind &kind : kinds_)
    if (atom->mask[i] & kind.membranes->groupbit()) return kind.excess;
  return 0;
}

/* ---------------------------------------------------------------------- */

void ViscosityContrast::take_off_wrong(const fluid::MarkerSet &markers, double *seen) const
{
  for (int n = 0; n < markers.count; ++n)
    for (int d = 0; d < 3; ++d) {
      const std::size_t row = 3 * std::size_t(markers.index[n]) + d;
      seen[row] -= wrong_[row];
    }
}

/* ----------------------------------------------------------------------
   What is seen of w is the velocity of the cell as a whole and 1 + e times that relative to it.
   What is left of that with the velocities of the layer is changed in the same way.
------------------------------------------------------------------------- */

void ViscosityContrast::read(const fluid::MarkerSet &markers, double *velocity)
{
  stopwatch_.start();
  left_.assign(strength_.size(), 0.0);
  for (int n = 0; n < markers.count; ++n)
    for (int d = 0; d < 3; ++d) {
      const std::size_t row = 3 * std::size_t(markers.index[n]) + d;
      left_[row] = velocity[row] - rigid_[row] - relative_[row] / part_[row];
      velocity[row] = rigid_[row] + relative_[row];
    }
  find_rigid(left_.data(), rigid_);
  for (int n = 0; n < markers.count; ++n)
    for (int d = 0; d < 3; ++d) {
      const std::size_t row = 3 * std::size_t(markers.index[n]) + d;
      velocity[row] += rigid_[row] + part_[row] * (left_[row] - rigid_[row]);
    }
  stopwatch_.stop();
}

/* ---------------------------------------------------------------------- */

int ViscosityContrast::add_rigid_layers(const fluid::MarkerSet &markers)
{
  find_rigid(atom->nlocal > 0 ? atom->v[0] : nullptr, rigid_);
  left_.resize(strength_.size());
  const fluid::DoubleLayer layer{rigid_.data(), strength_.data()};
  return flow_->add_layer(markers, layer, mean_excess(markers, rigid_.data()), left_.data());
}

/* ---------------------------------------------------------------------- */

std::size_t ViscosityContrast::bytes() const
{
  std::size_t numbers = 0;
  for (const auto *values :
       {&strength_, &place_, &part_, &wrong_, &rigid_, &relative_, &left_, &unit_, &remains_})
    numbers += values->capacity();
  std::size_t bytes = numbers * sizeof(double);
  for (const RigidMotions &motions : motions_) bytes += motions.bytes();
  return bytes;
}
