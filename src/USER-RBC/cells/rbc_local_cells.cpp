#include "cells/rbc_local_cells.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using rbc::Vec3;

LocalCells::LocalCells(LAMMPS *lmp, const rbc::SurfaceTemplate &shape, int groupbit,
                       std::string style) :
    Pointers(lmp),
    shape(shape), groupbit(groupbit), style(std::move(style)),
    directory(lmp, shape.vertex_count(), groupbit, this->style), images(lmp, shape, this->style),
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

  directory.identify();
  known_cells.clear();
  std::vector<tagint> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & groupbit) && (mine.empty() || mine.back() != atom->molecule[i]))
      mine.push_back(atom->molecule[i]);
  ask_for(std::move(mine));
}

/* ---------------------------------------------------------------------- */

void LocalCells::ask_for(std::vector<tagint> molecules)
{
  std::sort(molecules.begin(), molecules.end());
  molecules.erase(std::unique(molecules.begin(), molecules.end()), molecules.end());
  for (const auto &[molecule, first, index] : directory.find(molecules))
    known_cells.insert({molecule, {first, index, -1}});
}

/* ----------------------------------------------------------------------
   A single rank has vertices of all cells, whatever moves. Of several, each asks for the cells that
   are new to it, and nothing is sent as long as no rank meets one.
------------------------------------------------------------------------- */

void LocalCells::meet_cells()
{
  const int all = comm->nprocs > 1 ? atom->nlocal + atom->nghost : atom->nlocal;
  bigint numbers[2] = {0, 0};    // of owned vertices and of cells that are unknown here
  Known here;
  std::vector<tagint> unknown;
  tagint last = 0;
  for (int i = 0; i < all; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (i < atom->nlocal) ++numbers[0];
    const tagint molecule = atom->molecule[i];
    if (comm->nprocs == 1 || molecule == std::exchange(last, molecule)) continue;
    const auto found = known_cells.find(molecule);
    if (found == known_cells.end())
      unknown.push_back(molecule);
    else
      here.insert(*found);
  }
  numbers[1] = static_cast<bigint>(unknown.size());
  MPI_Allreduce(MPI_IN_PLACE, numbers, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  vertices_of_all = numbers[0];
  if (comm->nprocs > 1) known_cells = std::move(here);
  if (numbers[1] > 0) ask_for(std::move(unknown));
}

/* ---------------------------------------------------------------------- */

void LocalCells::update_ownership(bool bending)
{
  meet_cells();
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
  std::vector<int> owned_count;
  CollectiveStop stop(lmp);
  local.clear();
  atoms.clear();
  for (auto &known : known_cells) known.second.place = -1;

  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const auto found = known_cells.find(atom->molecule[i]);
    if (found == known_cells.end()) {
      stop.report(fmt::format(
          "{}: atom {} belongs to molecule {}, which was not there at the start of the run", style,
          atom->tag[i], atom->molecule[i]));
      continue;
    }
    KnownCell &cell = found->second;
    const tagint vertex = atom->tag[i] - cell.first;
    if (vertex < 0 || vertex >= size) {
      stop.report(
          fmt::format("{}: atom {} was not of the cell with molecule ID {} at the start of the run",
                      style, atom->tag[i], atom->molecule[i]));
      continue;
    }
    if (cell.place < 0) {
      cell.place = static_cast<int>(local.size());
      local.push_back(
          {cell.index, found->first, cell.first, nullptr, nullptr, {}, Vec3::Zero(), false});
      owned_count.push_back(0);
      atoms.resize(atoms.size() + size, -1);
    }
    ++owned_count[cell.place];
    atoms[std::size_t(cell.place) * size + vertex] = i;
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
    find_neighbors(at, local[c].first, owned, bending ? 2 : 1);
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
  if (vertices_of_all == count() * shape.vertex_count()) return;

  std::vector<CellDirectory::Part> parts;
  for (std::size_t c = 0; c < local.size(); ++c)
    parts.push_back({local[c].molecule, owned_count[c]});
  const CellDirectory::Part broken = directory.first_incomplete(std::move(parts));
  const std::string loss =
      fmt::format("{}: lost {} of {} vertices, which left the simulation box, at step {}: cell "
                  "with molecule ID {}",
                  style, shape.vertex_count() - broken.vertices, shape.vertex_count(),
                  update->ntimestep, broken.molecule);
  CollectiveStop stop(lmp);
  for (std::size_t c = 0; c < local.size(); ++c) {
    if (local[c].molecule != broken.molecule) continue;
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
                style, comm->get_comm_cutoff(), update->ntimestep, local[c].molecule, near[0],
                near[1], near[2], rings * shape.longest_edge),
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
  for (std::size_t c = 0; c < local.size(); ++c) local[c].offset = offsets[c];
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
      for (int d = 0; d < 3; ++d) position[3 * c + d] += atom->x[i][d] + local[c].offset[v][d];
    }
  sum_shared(position, 3);
  for (std::size_t c = 0; c < local.size(); ++c) {
    local[c].origin = Vec3(&position[3 * c]) / size;
    offsets.subtract(c, local[c].origin);
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

double LocalCells::bytes() const
{
  return directory.bytes() + static_cast<double>(offsets.bytes()) +
         static_cast<double>(known_cells.size() * (sizeof(Known::value_type) + 2 * sizeof(void *)));
}
