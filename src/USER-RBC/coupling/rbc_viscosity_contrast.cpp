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
  knows_surfaces_ = false;
  const double outside = flow->settings().equations.viscosity;
  for (CellMembranes *cells : membranes)
    if (cells->differs_inside(outside))
      kinds_.push_back({cells, cells->interior_viscosity() / outside - 1});
  if (acts() && contact_) widest_gap(*flow_, kernel);
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
  knows_surfaces_ = true;
  stopwatch_.stop();
}

int ViscosityContrast::find_seen(const fluid::MarkerSet &markers)
{
  const double mean = total_excess() / flow_->box_volume();
  unit_.assign(strength_.size(), 1.0);
  part_.resize(strength_.size());
  const fluid::DoubleLayer unit{unit_.data(), strength_.data()};
  const int outside =
      flow_->apply_mobility(markers, nullptr, part_.data(), &unit, {mean, mean, mean}, false);
  for (int n = 0; n < markers.count; ++n)
    for (int d = 0; d < 3; ++d) {
      double &part = part_[3 * std::size_t(markers.index[n]) + d];
      part = 1 / (1 + part);
    }
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

std::array<double, 3> ViscosityContrast::mean_excess(const fluid::MarkerSet &markers) const
{
  double **const v = atom->v;
  std::array<double, 3> mine{0, 0, 0}, all;
  for (int n = 0; n < markers.count; ++n) {
    const std::size_t row = 3 * std::size_t(markers.index[n]);
    double flux = 0;
    for (int d = 0; d < 3; ++d) flux += v[markers.index[n]][d] * strength_[row + d];
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
  if (contact_ || comm->nprocs > 1) comm->forward_comm_array(3, atom->v);
  add_blurred(markers.kernel);
  if (contact_) add_seen_across();
  const double *const velocity = atom->nlocal > 0 ? atom->v[0] : nullptr;
  const Moving moving{{velocity, strength_.data()}, mean_excess(markers)};
  stopwatch_.stop();
  return moving;
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
   A vertex that moves as the surface across the gap does sees w and the excess of the viscosity
   alike, and their ratio is right. A cell sees itself through its inside, where gaps count as
   negative: there it sees too little of its own layer.
------------------------------------------------------------------------- */

void ViscosityContrast::add_seen_across()
{
  double **const v = atom->v;
  const double spacing = flow_->mean_spacing();
  for (const rbc::VertexContact &contact : contact_->near_contacts()) {
    const double excess = excess_of(contact.corner[0]);
    const bool own = atom->molecule[contact.point] == atom->molecule[contact.corner[0]];
    const double gap = own ? std::abs(contact.gap) : contact.gap;
    if (excess == 0 || gap <= 0 || (own && gap >= contact_->own_gap())) continue;
    const double share = gaps_->share(gap / spacing);
    if (share == 0) continue;
    const double seen = own && contact.gap < 0 ? -SEEN * excess * share : SEEN * excess * share;
    for (int d = 0; d < 3; ++d) {
      double across = 0;
      for (int c = 0; c < 3; ++c) across += contact.weight[c] * v[contact.corner[c]][d];
      wrong_[3 * std::size_t(contact.point) + d] += seen * (across - v[contact.point][d]);
    }
  }
}

double ViscosityContrast::excess_of(int i) const
{
  for (const Kind &kind : kinds_)
    if (atom->mask[i] & kind.membranes->groupbit()) return kind.excess;
  return 0;
}

/* ---------------------------------------------------------------------- */

void ViscosityContrast::read(const fluid::MarkerSet &markers, double *velocity) const
{
  for (int n = 0; n < markers.count; ++n) {
    const std::size_t i = markers.index[n];
    for (int d = 0; d < 3; ++d)
      velocity[3 * i + d] = part_[3 * i + d] * (velocity[3 * i + d] - wrong_[3 * i + d]);
  }
}

/* ---------------------------------------------------------------------- */

std::size_t ViscosityContrast::bytes() const
{
  std::size_t numbers = 0;
  for (const auto *values : {&strength_, &place_, &part_, &wrong_, &unit_})
    numbers += values->capacity();
  return numbers * sizeof(double);
}
