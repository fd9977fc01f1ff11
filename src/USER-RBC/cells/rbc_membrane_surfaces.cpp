#include "cells/rbc_cell_membranes.h"

#include "atom.h"

using namespace LAMMPS_NS;

// What membranes tell of their surfaces.

/* ---------------------------------------------------------------------- */

void CellMembranes::visit_volume_gradients(const GradientVisitor &visit)
{
  const int size = shape().vertex_count();
  gradient_.resize(size);
  for (const LocalCells::Cell &cell : cells_.cells()) {
    cells_.gather(cell, x_);
    gradient_of_.find(*cell.elements, x_.data(), gradient_.data());
    for (int i = 0; i < size; ++i)
      if (cell.elements->owned[i]) visit(cell.atom[i], gradient_[i], x_[i]);
  }
}

/* ---------------------------------------------------------------------- */

void CellMembranes::visit_surface_shear(const ShearVisitor &visit)
{
  const int size = shape().vertex_count();
  v_.resize(size);
  gradient_.resize(size);
  area_.resize(size);
  for (const LocalCells::Cell &cell : cells_.cells()) {
    set_current_cell(cell);
    gather_velocities(cell);
    model_.surface_shear(v_.data(), gradient_.data(), area_.data());
    for (int i = 0; i < size; ++i)
      if (cell.elements->owned[i]) visit(cell.atom[i], gradient_[i] / area_[i]);
  }
}
