#include "compute_rbc_aggregate.h"

#include "atom.h"
#include "cells/rbc_cell_contact.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "support/rbc_arguments.h"
#include "support/rbc_gather.h"
#include "update.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::TouchedShare;
using rbc::Vec3;

static constexpr int NCOLS = 3;

/* ---------------------------------------------------------------------- */

ComputeRBCAggregate::ComputeRBCAggregate(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), cells(lmp, fmt::format("Compute rbc/aggregate {}", id)), rows_lock(lmp)
{
  Arguments args(lmp, "compute rbc/aggregate", narg, arg, 3);
  gap = args.positive("gap");
  args.read({{"area", [&] {
                least_share = args.number();
                if (!(least_share > 0 && least_share <= 1))
                  args.fail("Compute rbc/aggregate area {} must be a share of a cell's surface, "
                            "above 0 and at most 1",
                            least_share);
              }}});

  peratom_flag = 1;
  size_peratom_cols = 0;
  vector_flag = 1;
  size_vector = 5;
  extvector = 0;
  array_flag = 1;
  size_array_cols = NCOLS;
  size_array_rows = 0;
  size_array_rows_variable = 1;
  extarray = 0;
  memory->create(vector, size_vector, "rbc/aggregate:vector");
}

ComputeRBCAggregate::~ComputeRBCAggregate()
{
  memory->destroy(vector);
  memory->destroy(array);
  memory->destroy(vector_atom);
}

/* ---------------------------------------------------------------------- */

void ComputeRBCAggregate::init()
{
  if (domain->triclinic)
    error->all(FLERR, "Compute rbc/aggregate {} requires an orthogonal box", id);
  cells.find(groupbit);
  near.reset();
  if (!find_seeing()) look_for_itself();
  set_rows();
}

void ComputeRBCAggregate::cells_changed()
{
  cells.find_again(groupbit);
  if (near) near->cells_changed();
  set_rows();
}

void ComputeRBCAggregate::set_rows()
{
  found_step = -1;
  const int rows = rbc::AggregateSizes::class_count(cells.size());
  if (rows == size_array_rows && array) return;
  rows_lock.check(fmt::format("Compute rbc/aggregate {}: classes of size changed ({} before, {} "
                              "now)",
                              id, size_array_rows, rows));
  size_array_rows = rows;
  memory->destroy(array);
  memory->create(array, std::max(rows, 1), NCOLS, "rbc/aggregate:array");
}

/* ----------------------------------------------------------------------
   atoms may move by half of the skin before ghosts are chosen anew
------------------------------------------------------------------------- */

void ComputeRBCAggregate::setup()
{
  if (near) near->check_ghosts(gap, neighbor->skin);
}

/* ---------------------------------------------------------------------- */

void ComputeRBCAggregate::compute_vector()
{
  invoked_vector = update->ntimestep;
  find_aggregates();
  vector[0] = sizes.aggregates();
  vector[1] = sizes.mean();
  vector[2] = sizes.median();
  vector[3] = sizes.largest();
  vector[4] = sizes.single_share();
}

void ComputeRBCAggregate::compute_array()
{
  invoked_array = update->ntimestep;
  find_aggregates();
  for (int n = 0; n < size_array_rows; ++n) {
    const rbc::AggregateSizes::Class members = sizes.size_class(n);
    array[n][0] = static_cast<double>(members.lower);
    array[n][1] = members.aggregates;
    array[n][2] = members.fraction;
  }
}

void ComputeRBCAggregate::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  find_aggregates();
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(vector_atom);
    memory->create(vector_atom, nmax, "rbc/aggregate:vector_atom");
  }
  for (int i = 0; i < atom->nlocal; ++i) {
    const int cell = cells.cell_of(i);
    vector_atom[i] = cell < 0 ? 0 : static_cast<double>(cells.molecules()[sets.find(cell)]);
  }
}

/* ---------------------------------------------------------------------- */

void ComputeRBCAggregate::find_aggregates()
{
  if (found_step == update->ntimestep) return;
  cells.check();
  found_step = update->ntimestep;
  sets = rbc::DisjointSets(cells.size());
  rbc::unite_touching(sets, gather_all(touched_here(), world), least_share);
  sizes = rbc::AggregateSizes(sets);
}

/* ----------------------------------------------------------------------
   a pair style that sees as far as `gap`, or null
------------------------------------------------------------------------- */

const CellContact *ComputeRBCAggregate::find_seeing() const
{
  for (const CellContact *contact : find_cell_contacts(force))
    if (contact->seen_gap() >= gap) return contact;
  return nullptr;
}

void ComputeRBCAggregate::look_for_itself()
{
  near.emplace(lmp, fmt::format("Compute rbc/aggregate {}", id));
  near->init();
}

/* ----------------------------------------------------------------------
   All that are nearer than `gap`, and others. Within a run those that a pair style has found;
   between runs atoms may have changed since then.
------------------------------------------------------------------------- */

const std::vector<rbc::VertexContact> &ComputeRBCAggregate::contacts()
{
  if (update->whichflag != 0) {
    const CellContact *const contact = find_seeing();
    if (contact && contact->sees_this_step()) return contact->near_contacts();
  }
  if (!near) look_for_itself();
  near->build(gap, 0, neighbor->skin);
  return near->contacts(gap);
}

/* ----------------------------------------------------------------------
   what the vertices of this rank tell. Of a cell that it holds as a whole it knows whether it
   touches another, and only pairs that join aggregates here go to the other ranks; the shares of
   other cells are added up there.
------------------------------------------------------------------------- */

std::vector<TouchedShare> ComputeRBCAggregate::touched_here()
{
  const Surface surface = surface_here();
  std::vector<TouchedShare> touched;
  for (const rbc::VertexContact &contact : contacts()) {
    if (!(std::abs(contact.gap) < gap)) continue;
    const int cell = cells.index_of(atom->molecule[contact.point]);
    const int other = cells.index_of(atom->molecule[contact.corner[0]]);
    if (cell >= 0 && other >= 0 && cell != other)
      touched.push_back({cell, other, surface.share[contact.point]});
  }
  rbc::add_up(touched);

  rbc::DisjointSets joined(cells.size());
  std::vector<TouchedShare> needed;
  for (const TouchedShare &pair : touched) {
    const bool undecided = least_share > 0 && surface.split[pair.cell];
    if (undecided || (pair.share >= least_share && joined.unite(pair.cell, pair.other)))
      needed.push_back(pair);
  }
  return needed;
}

/* ----------------------------------------------------------------------
   a vertex has a third of the area of the triangles around it
------------------------------------------------------------------------- */

ComputeRBCAggregate::Surface ComputeRBCAggregate::surface_here() const
{
  Surface surface{std::vector<double>(atom->nlocal), std::vector<char>(cells.size())};
  if (least_share == 0) return surface;
  for (CellMembranes *membranes : cells.membranes()) {
    LocalCells &local = membranes->local_cells();
    std::vector<double> areas(local.cells().size());
    std::vector<Vec3> x(membranes->shape().vertex_count());
    for (std::size_t c = 0; c < areas.size(); ++c) {
      const LocalCells::Cell &cell = local.cells()[c];
      local.gather(cell, x);
      for (int t : cell.elements->triangles) {
        const auto &[i, j, k] = membranes->shape().triangles[t];
        const double third = (x[j] - x[i]).cross(x[k] - x[i]).norm() / 6;
        for (int v : {i, j, k}) {
          if (!cell.elements->owned[v]) continue;
          surface.share[cell.atom[v]] += third;
          areas[c] += third;
        }
      }
    }
    local.sum_shared(areas, 1);

    for (std::size_t c = 0; c < areas.size(); ++c) {
      const LocalCells::Cell &cell = local.cells()[c];
      for (int v = 0; v < membranes->shape().vertex_count(); ++v)
        if (cell.elements->owned[v]) surface.share[cell.atom[v]] /= areas[c];
      const int index = cells.index_of(cell.molecule);
      if (index >= 0) surface.split[index] = cell.shared;
    }
  }
  return surface;
}

/* ---------------------------------------------------------------------- */

double ComputeRBCAggregate::memory_usage()
{
  return static_cast<double>(nmax + size_array_rows * NCOLS) * sizeof(double) +
         static_cast<double>(cells.size()) * 2 * sizeof(int) + (near ? near->bytes() : 0);
}
