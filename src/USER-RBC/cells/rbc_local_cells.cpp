#include "cells/rbc_local_cells.h"

#include "atom.h"
#include "cells/rbc_cell_changes.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "support/rbc_gather.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using rbc::Vec3;

LocalCells::LocalCells(LAMMPS *lmp, const rbc::SurfaceTemplate &shape, int groupbit,
                       std::string style) :
    Pointers(lmp),
    shape(shape), groupbit(groupbit), style(std::move(style)), images(lmp, shape, this->style),
    whole(rbc::CellElements::whole(shape)), sums(lmp)
{
}

void LocalCells::identify()
{
  identify_again();
  starts_run = true;
}

void LocalCells::identify_again()
{
  if (!atom->molecule_flag || !atom->tag_enable)
    error->all(FLERR, "{} requires atoms with IDs and molecule IDs", style);
  if (atom->map_style == Atom::MAP_NONE)
    error->all(FLERR, "{} requires an atom map, see atom_modify", style);

  molecule_ids.clear();
  first_ids.clear();
  index_of.clear();
  for (const Extent &cell : find_extents()) {
    if (cell.molecule <= 0)
      error->all(FLERR, "{}: {} atoms of the group belong to no molecule", style, cell.count);
    if (cell.count != shape.vertex_count())
      error->all(FLERR,
                 "{}: the cell with molecule ID {} has {} atoms in the group, its template {}",
                 style, cell.molecule, cell.count, shape.vertex_count());
    if (cell.last - cell.first + 1 != shape.vertex_count())
      error->all(FLERR,
                 "{}: the atom IDs of the cell with molecule ID {} are not consecutive ({} to {})",
                 style, cell.molecule, cell.first, cell.last);
    index_of[cell.molecule] = static_cast<int>(molecule_ids.size());
    molecule_ids.push_back(cell.molecule);
    first_ids.push_back(cell.first);
  }
  if (molecule_ids.empty() && !is_fed(lmp, groupbit))
    error->all(FLERR, "{}: its group has no atoms; define the group after the cells are made",
               style);
}

/* ----------------------------------------------------------------------
   of all molecules of the group, in order of molecule ID
------------------------------------------------------------------------- */

std::vector<LocalCells::Extent> LocalCells::find_extents() const
{
  std::vector<Extent> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const tagint tag = atom->tag[i];
    mine.push_back({std::max<tagint>(atom->molecule[i], 0), tag, tag, 1});
  }
  return gather_molecules(std::move(mine), world);
}

void LocalCells::Extent::include(const Extent &other)
{
  first = std::min(first, other.first);
  last = std::max(last, other.last);
  count += other.count;
}

void LocalCells::update_ownership(bool bending)
{
  const std::vector<int> owned_count = find_owned();
  check_complete(owned_count);
  find_parts(owned_count, bending);
  find_partners();
  find_images(std::exchange(starts_run, false));
  set_origins();
}

/* ----------------------------------------------------------------------
   Sets local and atoms to the vertices owned. Returns how many of each cell there are.
------------------------------------------------------------------------- */

std::vector<int> LocalCells::find_owned()
{
  const int size = shape.vertex_count();
  std::vector<int> slot(molecule_ids.size(), -1);
  std::vector<int> owned_count;
  CollectiveStop stop(lmp);
  local.clear();
  atoms.clear();

  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const auto found = index_of.find(atom->molecule[i]);
    if (found == index_of.end()) {
      stop.report(fmt::format(
          "{}: atom {} belongs to molecule {}, which was not there at the start of the run", style,
          atom->tag[i], atom->molecule[i]));
      continue;
    }
    const int index = found->second;
    const tagint vertex = atom->tag[i] - first_ids[index];
    if (vertex < 0 || vertex >= size) {
      stop.report(
          fmt::format("{}: atom {} was not of the cell with molecule ID {} at the start of the run",
                      style, atom->tag[i], atom->molecule[i]));
      continue;
    }
    if (slot[index] < 0) {
      slot[index] = static_cast<int>(local.size());
      local.push_back({index, nullptr, nullptr, nullptr, Vec3::Zero(), false});
      owned_count.push_back(0);
      atoms.resize(atoms.size() + size, -1);
    }
    ++owned_count[slot[index]];
    atoms[std::size_t(slot[index]) * size + vertex] = i;
  }

  stop.check();
  return owned_count;
}

/* ----------------------------------------------------------------------
   adds the vertices of other ranks on which forces depend
------------------------------------------------------------------------- */

void LocalCells::find_parts(const std::vector<int> &owned_count, bool bending)
{
  const int size = shape.vertex_count();
  CollectiveStop stop(lmp);
  parts.clear();
  parts.reserve(local.size());
  for (std::size_t c = 0; c < local.size(); ++c) {
    const std::size_t at = c * size;
    local[c].atom = &atoms[at];
    local[c].elements = &whole;
    if (owned_count[c] == size) continue;

    std::vector<char> owned(size);
    for (int v = 0; v < size; ++v) owned[v] = atoms[at + v] >= 0;
    local[c].shared = true;
    find_neighbors(at, first_ids[local[c].index], owned, bending ? 2 : 1);
    parts.push_back(rbc::CellElements::part(shape, std::move(owned), bending));
    local[c].elements = &parts.back();
    check_neighbors(c, bending ? 3 : 2, stop);
  }
  stop.check();
}

/* ----------------------------------------------------------------------
   Ends the run if vertices are missing: LAMMPS deletes atoms that leave a box through a side that
   is not periodic.
------------------------------------------------------------------------- */

void LocalCells::check_complete(const std::vector<int> &owned_count) const
{
  bigint owned = 0, all;
  for (int count : owned_count) owned += count;
  MPI_Allreduce(&owned, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all == static_cast<bigint>(molecule_ids.size()) * shape.vertex_count()) return;

  std::vector<int> left(molecule_ids.size());
  for (std::size_t c = 0; c < local.size(); ++c) left[local[c].index] = owned_count[c];
  MPI_Allreduce(MPI_IN_PLACE, left.data(), static_cast<int>(left.size()), MPI_INT, MPI_SUM, world);
  const auto broken = std::find_if(left.begin(), left.end(),
                                   [this](int count) { return count < shape.vertex_count(); });
  const int index = static_cast<int>(broken - left.begin());
  const std::string loss =
      fmt::format("{}: lost {} of {} vertices, which left the simulation box, at step {}: cell "
                  "with molecule ID {}",
                  style, shape.vertex_count() - *broken, shape.vertex_count(), update->ntimestep,
                  molecule_ids[index]);
  CollectiveStop stop(lmp);
  for (std::size_t c = 0; c < local.size(); ++c) {
    if (local[c].index != index) continue;
    const int *const known = &atoms[c * shape.vertex_count()];
    const double *const near =
        atom->x[*std::find_if(known, known + shape.vertex_count(), [](int i) { return i >= 0; })];
    stop.report(fmt::format("{} near ({:.6g}, {:.6g}, {:.6g})", loss, near[0], near[1], near[2]));
  }
  stop.check();
  error->all(FLERR, "{}", loss);
}

/* ----------------------------------------------------------------------
   vertices of other ranks within some rings of the owned ones
------------------------------------------------------------------------- */

void LocalCells::find_neighbors(std::size_t at, tagint first, const std::vector<char> &owned,
                                int rings)
{
  std::vector<int> front;
  for (int v = 0; v < shape.vertex_count(); ++v)
    if (owned[v]) front.push_back(v);
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<int> next;
    for (int v : front)
      for (int w : shape.neighbors[v]) {
        if (atoms[at + w] >= 0) continue;
        const int j = atom->map(first + w);
        if (j < 0) continue;
        atoms[at + w] = j;
        next.push_back(w);
      }
    front = std::move(next);
  }
}

/* ----------------------------------------------------------------------
   Reports a vertex that forces on the cell's owned vertices need and that is no ghost here: the
   ghost cutoff is too short.
------------------------------------------------------------------------- */

void LocalCells::check_neighbors(std::size_t c, int rings, CollectiveStop &stop) const
{
  const int *const known = local[c].atom;
  int owned = -1;
  for (int v = 0; v < shape.vertex_count() && owned < 0; ++v)
    if (local[c].elements->owned[v]) owned = known[v];
  const double *const near = atom->x[owned];
  for (int t : local[c].elements->triangles)
    for (int v : shape.triangles[t])
      if (known[v] < 0)
        return stop.report(
            fmt::format(
                "{}: ghost cutoff {} is too short at step {} for the cell with molecule ID {} near "
                "({:.6g}, {:.6g}, {:.6g}): a neighbor of its vertices is unknown; its edges are "
                "stretched too far, or use comm_modify cutoff (at rest at least {})",
                style, comm->get_comm_cutoff(), update->ntimestep, molecule_ids[local[c].index],
                near[0], near[1], near[2], rings * shape.longest_edge),
            Flaw::stretched);
}

void LocalCells::find_partners()
{
  std::vector<SharedSums::Part> mine;
  for (std::size_t c = 0; c < local.size(); ++c)
    if (local[c].shared) mine.push_back({local[c].index, static_cast<int>(c)});
  sums.find_partners(std::move(mine));
}

void LocalCells::find_images(bool starts_run)
{
  if (starts_run) images.correct_flags(*this);
  images.find_offsets(*this, offsets);
  for (std::size_t c = 0; c < local.size(); ++c)
    local[c].offset = &offsets[c * shape.vertex_count()];
}

/* ----------------------------------------------------------------------
   the mean of the vertices, which all ranks that share a cell agree on
------------------------------------------------------------------------- */

void LocalCells::set_origins()
{
  const int size = shape.vertex_count();
  std::vector<double> position(3 * local.size());
  for (std::size_t c = 0; c < local.size(); ++c)
    for (int v = 0; v < size; ++v) {
      if (!local[c].elements->owned[v]) continue;
      const int i = atoms[c * size + v];
      for (int d = 0; d < 3; ++d) position[3 * c + d] += atom->x[i][d] + offsets[c * size + v][d];
    }
  sum_shared(position, 3);
  for (std::size_t c = 0; c < local.size(); ++c) {
    local[c].origin = Vec3(&position[3 * c]) / size;
    for (int v = 0; v < size; ++v) offsets[c * size + v] -= local[c].origin;
  }
}

void LocalCells::gather(const Cell &cell, std::vector<Vec3> &x) const
{
  const double *const *const position = atom->x;
  const int size = shape.vertex_count();
  for (int v = 0; v < size; ++v)
    if (cell.atom[v] >= 0) x[v] = Vec3(position[cell.atom[v]]) + cell.offset[v];
}

void LocalCells::sum_shared(std::vector<double> &values, int width)
{
  sums.sum(values.data(), width);
}
