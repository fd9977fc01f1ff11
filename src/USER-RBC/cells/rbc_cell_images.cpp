#include "cells/rbc_cell_images.h"

#include "atom.h"
#include "cells/rbc_local_cells.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using rbc::Vec3;

CellImages::CellImages(LAMMPS *lmp, const rbc::SurfaceTemplate &shape, std::string style) :
    Pointers(lmp), shape(shape), style(std::move(style)), joined(shape)
{
}

/* ----------------------------------------------------------------------
   Joins the vertices by their edges, from the first one on, whatever the image flags of the others
   are: what was read may have none. A rank that has not got the first vertex continues from
   vertices that other ranks have placed.
------------------------------------------------------------------------- */

void CellImages::put_together(const LocalCells &cells)
{
  const std::size_t size = shape.vertex_count();
  const auto &local = cells.cells();
  shifts.assign(local.size() * size, Vec3::Zero());
  placed.assign(shifts.size(), 0);
  Vec3 periods = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (domain->periodicity[d]) periods[d] = domain->prd[d];
  joined.set_periods(periods);

  for (std::size_t c = 0; c < local.size(); ++c) {
    if (!local[c].elements->owned[0]) continue;
    double zero[3] = {0, 0, 0};
    domain->unmap(zero, atom->image[local[c].atom[0]], shifts[c * size].data());
    placed[c * size] = 1;
    joined.join(vertices(cells, c));
  }
  bigint before = MAXBIGINT;
  for (bigint missing = count_missing(cells); missing > 0; missing = count_missing(cells)) {
    if (missing >= before)
      error->all(FLERR,
                 "{}: parts of cells on different MPI tasks do not meet; raise the ghost "
                 "cutoff with comm_modify cutoff",
                 style);
    before = missing;
    take_from_neighbors(cells);
  }
}

/* ----------------------------------------------------------------------
   sets wrapped and is_known
------------------------------------------------------------------------- */

void CellImages::set_current_cell(const int *atoms)
{
  const int size = shape.vertex_count();
  wrapped.resize(size);
  is_known.resize(size);
  for (int v = 0; v < size; ++v) {
    is_known[v] = atoms[v] >= 0;
    if (is_known[v]) wrapped[v] = Vec3(atom->x[atoms[v]]);
  }
}

/* ----------------------------------------------------------------------
   the result is valid until the next call
------------------------------------------------------------------------- */

rbc::JoinedVertices::Cell CellImages::vertices(const LocalCells &cells, std::size_t c)
{
  set_current_cell(cells.cells()[c].atom);
  const std::size_t at = c * shape.vertex_count();
  return {wrapped.data(), is_known.data(), &placed[at], &shifts[at]};
}

bigint CellImages::count_missing(const LocalCells &cells) const
{
  if (comm->nprocs == 1) return 0;
  const std::size_t size = shape.vertex_count();
  bigint missing = 0;
  for (std::size_t n = 0; n < placed.size(); ++n)
    missing += cells.cells()[n / size].atom[n % size] >= 0 && !placed[n];
  MPI_Allreduce(MPI_IN_PLACE, &missing, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return missing;
}

/* ----------------------------------------------------------------------
   positions of ghosts as their owners have placed them, infinite where they have not
------------------------------------------------------------------------- */

void CellImages::take_from_neighbors(const LocalCells &cells)
{
  const int all = atom->nlocal + atom->nghost, size = shape.vertex_count();
  numbers.assign(3 * std::size_t(all), HUGE_VAL);
  rows.resize(all);
  for (int i = 0; i < all; ++i) rows[i] = &numbers[3 * std::size_t(i)];
  const auto &local = cells.cells();
  for (std::size_t n = 0; n < placed.size(); ++n) {
    const int i = local[n / size].atom[n % size];
    if (i < 0 || i >= atom->nlocal || !placed[n]) continue;
    for (int d = 0; d < 3; ++d) rows[i][d] = atom->x[i][d] + shifts[n][d];
  }
  comm->forward_comm_array(3, rows.data());

  for (std::size_t c = 0; c < local.size(); ++c) {
    if (!local[c].shared) continue;
    for (int v = 0; v < size; ++v) {
      const std::size_t n = c * size + v;
      const int i = local[c].atom[v];
      if (i < 0 || placed[n] || rows[i][0] == HUGE_VAL) continue;
      for (int d = 0; d < 3; ++d)
        if (domain->periodicity[d])
          shifts[n][d] = std::round((rows[i][d] - atom->x[i][d]) / domain->prd[d]) * domain->prd[d];
      placed[n] = 1;
    }
    joined.join(vertices(cells, c));
  }
}

/* ----------------------------------------------------------------------
   Gives the vertices the image flags with which put_together() has joined them. From here on LAMMPS
   keeps them, however far a cell is drawn out. A cell stays as its flags say if it is drawn out so
   far already that vertices with a common edge are more than half of the box apart.
------------------------------------------------------------------------- */

void CellImages::correct_flags(LocalCells &cells)
{
  put_together(cells);
  const int size = shape.vertex_count();
  const auto &local = cells.cells();
  std::vector<double> drawn_out(local.size());
  for (std::size_t c = 0; c < local.size(); ++c)
    drawn_out[c] = joined.widest(vertices(cells, c)).ratio > 1 + 1e-9;
  cells.sum_shared(drawn_out, 1);

  std::vector<double> corrected(local.size());
  for (std::size_t c = 0; c < local.size(); ++c) {
    if (drawn_out[c] > 0) continue;
    for (int v = 0; v < size; ++v) {
      if (!local[c].elements->owned[v]) continue;
      imageint &flags = atom->image[local[c].atom[v]];
      const imageint right = flags_of(shifts[c * size + v], flags);
      corrected[c] += flags != right;
      flags = right;
    }
  }
  free_memory();
  warn_of_corrections(cells, corrected);
}

imageint CellImages::flags_of(const Vec3 &shift, imageint old) const
{
  imageint flags = 0;
  constexpr int bits[3] = {0, IMGBITS, IMG2BITS};
  for (int d = 0; d < 3; ++d) {
    imageint boxes = (old >> bits[d]) & IMGMASK;
    if (domain->periodicity[d])
      boxes = (static_cast<imageint>(std::lround(shift[d] / domain->prd[d])) + IMGMAX) & IMGMASK;
    flags |= boxes << bits[d];
  }
  return flags;
}

void CellImages::warn_of_corrections(LocalCells &cells, std::vector<double> &corrected)
{
  cells.sum_shared(corrected, 1);
  bigint mine = 0, count;
  for (std::size_t c = 0; c < corrected.size(); ++c)
    mine += corrected[c] > 0 && cells.cells()[c].elements->owned[0];
  MPI_Allreduce(&mine, &count, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (count > 0 && comm->me == 0)
    error->warning(FLERR,
                   "{}: image flags of vertices of {} cells did not fit each other at step {}: "
                   "they were set anew, so that the edges of cells are short",
                   style, count, update->ntimestep);
}

/* ----------------------------------------------------------------------
   Image flags tell which image of a vertex is the cell's. They begin anew beyond a number of boxes;
   a cell that lies on both sides of that is kept whole where its first vertex is.
------------------------------------------------------------------------- */

void CellImages::find_offsets(LocalCells &cells, CellOffsets &offsets)
{
  const int size = shape.vertex_count();
  const auto &local = cells.cells();
  const double *const *const boxes_of = find_boxes(cells.has_shared());

  const auto counts = count_far(cells, boxes_of);
  constexpr double near[9] = {};
  std::vector<Vec3> of_vertices(size, Vec3::Zero());
  offsets.clear();
  for (std::size_t c = 0; c < local.size(); ++c) {
    for (int v = 0; v < size; ++v) {
      if (local[c].atom[v] < 0) continue;
      for (int d = 0; d < 3; ++d) {
        const double *const count = counts.empty() ? near : &counts[9 * c + d];
        double n = boxes_of[local[c].atom[v]][d];
        if (count[0] > 0 && count[3] > 0) n += 2 * IMGMAX * ((n < -IMGMAX / 2) - (count[6] > 0));
        of_vertices[v][d] = n * domain->prd[d];
      }
    }
    offsets.add(of_vertices, local[c].atom);
  }
  free_memory();
}

/* ----------------------------------------------------------------------
   These vectors take as much memory as the atoms themselves, and are needed now and then only.
------------------------------------------------------------------------- */

void CellImages::free_memory()
{
  std::vector<Vec3>().swap(shifts);
  std::vector<char>().swap(placed);
  std::vector<double>().swap(numbers);
  std::vector<double *>().swap(rows);
}

/* ----------------------------------------------------------------------
   Returns for each cell and direction how many vertices are far below and far above, and whether
   the first one is far below: nine numbers a cell, or none if no vertex is far on any rank.
------------------------------------------------------------------------- */

std::vector<double> CellImages::count_far(LocalCells &cells, const double *const *boxes_of)
{
  const int size = shape.vertex_count();
  const auto &local = cells.cells();
  std::vector<double> counts(9 * local.size());
  int is_far = 0;
  for (std::size_t c = 0; c < local.size(); ++c)
    for (int v = 0; v < size; ++v) {
      if (!local[c].elements->owned[v]) continue;
      for (int d = 0; d < 3; ++d) {
        const double n = boxes_of[local[c].atom[v]][d];
        const bool below = n<-IMGMAX / 2, above = n> IMGMAX / 2;
        if (!below && !above) continue;
        is_far = 1;
        counts[9 * c + d] += below;
        counts[9 * c + 3 + d] += above;
        counts[9 * c + 6 + d] += v == 0 && below;
      }
    }
  if (cells.has_shared()) MPI_Allreduce(MPI_IN_PLACE, &is_far, 1, MPI_INT, MPI_MAX, world);
  if (!is_far) return {};
  cells.sum_shared(counts, 9);
  return counts;
}

/* ----------------------------------------------------------------------
   Returns for each atom here in how many boxes from its position it is unwrapped: its image flags,
   or, for a ghost, those that lead to where its owner is.
------------------------------------------------------------------------- */

const double *const *CellImages::find_boxes(bool of_ghosts)
{
  const int all = atom->nlocal + atom->nghost, here = of_ghosts ? all : atom->nlocal;
  numbers.resize(3 * std::size_t(here));
  rows.resize(here);
  for (int i = 0; i < here; ++i) {
    rows[i] = &numbers[3 * std::size_t(i)];
    if (i >= atom->nlocal) continue;
    rows[i][0] = (atom->image[i] & IMGMASK) - IMGMAX;
    rows[i][1] = (atom->image[i] >> IMGBITS & IMGMASK) - IMGMAX;
    rows[i][2] = (atom->image[i] >> IMG2BITS) - IMGMAX;
  }
  if (!of_ghosts) return rows.data();

  const double *const *const x = atom->x;
  for (int i = 0; i < atom->nlocal; ++i)
    for (int d = 0; d < 3; ++d) rows[i][d] = x[i][d] + rows[i][d] * domain->prd[d];
  comm->forward_comm_array(3, rows.data());
  for (int i = 0; i < all; ++i)
    for (int d = 0; d < 3; ++d) rows[i][d] = std::round((rows[i][d] - x[i][d]) / domain->prd[d]);
  return rows.data();
}

CellImages::Stretch CellImages::largest_stretch(LocalCells &cells)
{
  const int size = shape.vertex_count();
  const auto &local = cells.cells();
  double ratio = 0;
  tagint molecule = MAXTAGINT;
  for (std::size_t c = 0; c < local.size(); ++c) {
    set_current_cell(local[c].atom);
    shifts.resize(size);
    for (int v = 0; v < size; ++v) shifts[v] = local[c].offset[v];
    const rbc::JoinedVertices::Edge edge =
        joined.most_stretched({wrapped.data(), is_known.data(), is_known.data(), shifts.data()});
    if (edge.ratio <= ratio) continue;
    ratio = edge.ratio;
    molecule = local[c].molecule;
  }
  double largest;
  MPI_Allreduce(&ratio, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  if (ratio < largest) molecule = MAXTAGINT;
  MPI_Allreduce(MPI_IN_PLACE, &molecule, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  return {largest, molecule};
}
