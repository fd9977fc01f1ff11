#include "cells/rbc_rigid_motions.h"

#include "cells/rbc_cell_membranes.h"

using namespace LAMMPS_NS;
using rbc::RigidFit;
using rbc::Vec3;

/* ----------------------------------------------------------------------
   calls visit(c, v, i) for each vertex v of cell c here that is an atom i of this rank
------------------------------------------------------------------------- */

template <typename Visit> void RigidMotions::visit_vertices(Visit visit) const
{
  const auto &cells = membranes_.local_cells().cells();
  const int size = membranes_.shape().vertex_count();
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int v = 0; v < size; ++v)
      if (cells[c].elements->owned[v]) visit(c, v, cells[c].atom[v]);
}

/* ---------------------------------------------------------------------- */

void RigidMotions::find_places(const double *const *x)
{
  LocalCells &local = membranes_.local_cells();
  const auto &cells = local.cells();
  sums_.assign(RigidFit::of_places * cells.size(), 0.0);
  places_.clear();
  visit_vertices([&](std::size_t c, int v, int i) {
    places_.push_back(Vec3(x[i]) + cells[c].offset[v]);
    RigidFit::add_place(places_.back(), &sums_[RigidFit::of_places * c]);
  });
  local.sum_shared(sums_, RigidFit::of_places);
  fits_.clear();
  for (std::size_t c = 0; c < cells.size(); ++c)
    fits_.emplace_back(&sums_[RigidFit::of_places * c], membranes_.shape().vertex_count());
  auto place = places_.begin();
  visit_vertices([&](std::size_t c, int /*v*/, int /*i*/) { *place++ -= fits_[c].centre; });
}

/* ---------------------------------------------------------------------- */

void RigidMotions::find(const double *velocity, double *rigid)
{
  LocalCells &local = membranes_.local_cells();
  const int size = membranes_.shape().vertex_count();
  sums_.assign(RigidFit::of_velocities * fits_.size(), 0.0);
  auto place = places_.cbegin();
  visit_vertices([&](std::size_t c, int /*v*/, int i) {
    RigidFit::add_velocity(*place++, Vec3(velocity + 3 * std::size_t(i)),
                           &sums_[RigidFit::of_velocities * c]);
  });
  local.sum_shared(sums_, RigidFit::of_velocities);
  place = places_.cbegin();
  visit_vertices([&](std::size_t c, int /*v*/, int i) {
    const auto motion = fits_[c].motion(&sums_[RigidFit::of_velocities * c], size);
    const Vec3 moves = motion.at(*place++);
    for (int d = 0; d < 3; ++d) rigid[3 * std::size_t(i) + d] = moves[d];
  });
}

/* ---------------------------------------------------------------------- */

std::size_t RigidMotions::bytes() const
{
  return fits_.capacity() * sizeof(RigidFit) + places_.capacity() * sizeof(Vec3) +
         sums_.capacity() * sizeof(double);
}
