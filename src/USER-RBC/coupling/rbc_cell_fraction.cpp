#include "coupling/rbc_cell_fraction.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "error.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

const fluid::ScalarField &CellFraction::find(fluid::Flow &flow)
{
  if (all_cell_membranes(lmp).empty() || modify->get_fix_by_style("^rbc/ib$").empty())
    error->all(FLERR, "Fix rbc/fluid grid data interior needs a fix rbc/membrane and a fix rbc/ib");
  if (flow.equations().scheme == fluid::Scheme::projection)
    error->all(FLERR, "Fix rbc/fluid grid data interior needs scheme coupled");
  if (!(share_.box() == flow.brick()) || !share_.bytes()) share_ = fluid::ScalarField(flow.brick());
  const fluid::Grid &grid = flow.grid();
  const double mean = total_volume() / (grid.cell_volume() * static_cast<double>(grid.size()));
  double **const x = atom->x;
  const fluid::MarkerSet markers{fluid::default_kernel, fluid::MarkerKind::points,
                                 static_cast<int>(vertices_.size()), vertices_.data(),
                                 vertices_.empty() ? nullptr : x[0]};
  const int outside = flow.find_inside(markers, area_.data(), mean, share_);
  if (outside >= 0)
    error->one(FLERR,
               "Fix rbc/fluid grid data interior: vertex with atom ID {} is outside the fluid",
               atom->tag[outside]);
  fluid::for_each_cell(flow.brick(), [share = share_[0]](int i, int j, int k) {
    share(i, j, k) = std::clamp(share(i, j, k), 0.0, 1.0);
  });
  return share_;
}

/* ----------------------------------------------------------------------
   Also finds the vertices here and their areas.
------------------------------------------------------------------------- */

double CellFraction::total_volume()
{
  vertices_.clear();
  area_.assign(3 * std::size_t(atom->nlocal), 0.0);
  double mine = 0, all;
  for (CellMembranes *membranes : all_cell_membranes(lmp))
    membranes->visit_volume_gradients(
        [&](int i, const rbc::Vec3 &gradient, const rbc::Vec3 &place) {
          vertices_.push_back(i);
          for (int d = 0; d < 3; ++d) area_[3 * std::size_t(i) + d] = gradient[d];
          mine += gradient.dot(place) / 3;
        });
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ---------------------------------------------------------------------- */

std::size_t CellFraction::bytes() const
{
  return share_.bytes() + vertices_.capacity() * sizeof(int) + area_.capacity() * sizeof(double);
}
