#include "coupling/rbc_traction_filter.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "coupling/rbc_driven_flow.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

// Tractions whose wavenumber times dx is above this are halved or more: kernels spread little of
// them.

static constexpr double RESOLVED = 2.0;

// How far rough tractions move vertices: about as much as the grid moves them where edges are one
// fluid cell long. More would make the membrane relax faster, and timesteps shorter.

static constexpr double SLIP = 0.03;

static rbc::SurfaceFilter::Row row_of(const double *numbers)
{
  return {numbers[0], numbers[1], numbers[2], 0};
}

static constexpr int MODES = rbc::SurfaceFilter::modes;
static constexpr int PARTS = 3 * MODES;

/* ---------------------------------------------------------------------- */

TractionFilter::TractionFilter(LAMMPS *lmp, RowExchange &exchange) :
    Pointers(lmp), exchange_(exchange), force_(exchange.work(0)), rough_(exchange.work(1))
{
}

void TractionFilter::start_run(const DrivenFlow &flow,
                               const std::vector<CellMembranes *> &membranes)
{
  slip_ = SLIP * flow.mean_spacing() / flow.settings().equations.viscosity;
  kinds_.clear();
  for (CellMembranes *cells : membranes)
    if (cells->is_smoothed())
      kinds_.push_back({cells, {cells->shape(), RESOLVED / flow.mean_spacing()}, {}, {}});
}

/* ----------------------------------------------------------------------
   function(v, i) for each vertex v of a cell that is an atom i of this rank
------------------------------------------------------------------------- */

template <class Function>
void TractionFilter::for_owned(const LocalCells::Cell &cell, const Kind &kind,
                               Function function) const
{
  const int owned = atom->nlocal, vertices = kind.filter.vertex_count();
  for (int v = 0; v < vertices; ++v)
    if (const int i = cell.atom[v]; i >= 0 && i < owned) function(v, i);
}

/* ----------------------------------------------------------------------
   function(c, v, i), with the number c of the cell here, for the cells that other ranks have a part
   of, too
------------------------------------------------------------------------- */

template <class Function>
void TractionFilter::for_shared_vertices(const Kind &kind, Function function) const
{
  const auto &cells = kind.membranes->local_cells().cells();
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (cells[c].shared) for_owned(cells[c], kind, [&](int v, int i) { function(c, v, i); });
}

/* ----------------------------------------------------------------------
   Filters the function whose value is load(kind, v, i) at the vertex v that is atom i, called once
   for each. Each result goes to store(kind, v, i, result). What load() takes from the rows force_
   of an atom is lost, where ranks share its cell: they hold the function then.
------------------------------------------------------------------------- */

template <class Load, class Store> void TractionFilter::filter(Load load, Store store)
{
  filter_whole_cells(load, store);
  const bool shared = std::any_of(kinds_.begin(), kinds_.end(), [](const Kind &kind) {
    return kind.membranes->local_cells().has_shared();
  });
  if (!shared) return;

  for (const Kind &kind : kinds_)
    for_shared_vertices(kind, [&](std::size_t /*c*/, int v, int i) {
      const Row value = load(kind, v, i);
      std::copy_n(value.data(), 3, force_[i]);
    });
  filter_shared_cells();
  for (const Kind &kind : kinds_)
    for_shared_vertices(
        kind, [&](std::size_t /*c*/, int v, int i) { store(kind, v, i, row_of(force_[i])); });
}

template <class Load, class Store> void TractionFilter::filter_whole_cells(Load load, Store store)
{
  for (const Kind &kind : kinds_) {
    const int vertices = kind.filter.vertex_count();
    const auto &cells = kind.membranes->local_cells().cells();
    cells_.resize(vertices);
    scratch_.resize(vertices);
    const auto next_whole = [&](std::size_t c) {
      while (c < cells.size() && cells[c].shared) ++c;
      return c;
    };
    for (std::size_t one = next_whole(0); one < cells.size();) {
      const std::size_t other = next_whole(one + 1);
      for (int v = 0; v < vertices; ++v) {
        cells_[v].head<4>() = load(kind, v, cells[one].atom[v]);
        cells_[v].tail<4>() =
            other < cells.size() ? load(kind, v, cells[other].atom[v]) : Row(Row::Zero());
      }
      kind.filter.apply(cells_, scratch_);
      for (int v = 0; v < vertices; ++v) {
        store(kind, v, cells[one].atom[v], cells_[v].head<4>());
        if (other < cells.size()) store(kind, v, cells[other].atom[v], cells_[v].tail<4>());
      }
      one = next_whole(other + 1);
    }
  }
}

/* ----------------------------------------------------------------------
   each pass needs the neighbors of vertices, which may be ghosts
------------------------------------------------------------------------- */

void TractionFilter::filter_shared_cells()
{
  int passes = 0;
  for (Kind &kind : kinds_) {
    take_linear(kind, kind.kept);
    passes = std::max(passes, kind.filter.passes());
  }
  for (int number = 0; number < passes; ++number) {
    exchange_.send_to_ghosts(force_);
    for (const Kind &kind : kinds_) {
      if (number >= kind.filter.passes()) continue;
      const auto &cells = kind.membranes->local_cells().cells();
      after_.clear();
      for_shared_vertices(kind, [&](std::size_t c, int v, int /*i*/) {
        const auto value = [&](int w) { return row_of(force_[cells[c].atom[w]]); };
        after_.push_back(kind.filter.pass(number, v, value));
      });
      auto after = after_.begin();
      for_shared_vertices(kind, [&](std::size_t /*c*/, int /*v*/, int i) {
        std::copy_n((after++)->data(), 3, force_[i]);
      });
    }
  }
  for (Kind &kind : kinds_) {
    take_linear(kind, kind.lost);
    add_linear(kind, kind.kept, 1);
  }
}

/* ----------------------------------------------------------------------
   Takes from the function in force_ its linear part, which `parts` becomes: for each cell here and
   each mode of the filter three numbers.
------------------------------------------------------------------------- */

void TractionFilter::take_linear(Kind &kind, std::vector<double> &parts)
{
  LocalCells &cells = kind.membranes->local_cells();
  parts.assign(PARTS * cells.cells().size(), 0.0);
  for_shared_vertices(kind, [&](std::size_t c, int v, int i) {
    for (int m = 0; m < MODES; ++m)
      for (int d = 0; d < 3; ++d)
        parts[PARTS * c + 3 * m + d] +=
            kind.filter.area(v) * kind.filter.linear(v)[m] * force_[i][d];
  });
  cells.sum_shared(parts, PARTS);
  add_linear(kind, parts, -1);
}

void TractionFilter::add_linear(const Kind &kind, const std::vector<double> &parts, double factor)
{
  for_shared_vertices(kind, [&](std::size_t c, int v, int i) {
    for (int m = 0; m < MODES; ++m)
      for (int d = 0; d < 3; ++d)
        force_[i][d] += factor * kind.filter.linear(v)[m] * parts[PARTS * c + 3 * m + d];
  });
}

/* ---------------------------------------------------------------------- */

const double *TractionFilter::smooth_forces(const double *force, double factor)
{
  stopwatch_.start();
  force_.resize(atom->nlocal + atom->nghost);
  rough_.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i)
    for (int d = 0; d < 3; ++d) force_[i][d] = factor * force[3 * std::size_t(i) + d];
  filter(
      [&](const Kind &kind, int v, int i) -> Row {
        const Row traction = row_of(force_[i]) / kind.filter.area(v);
        std::copy_n(traction.data(), 3, rough_[i]);
        return traction;
      },
      [&](const Kind &kind, int v, int i, const Row &smooth) {
        const Row rough = row_of(rough_[i]) - smooth, felt = kind.filter.area(v) * smooth;
        std::copy_n(rough.data(), 3, rough_[i]);
        std::copy_n(felt.data(), 3, force_[i]);
      });
  stopwatch_.stop();
  return force_[0];
}

void TractionFilter::leave_out_forces()
{
  rough_.assign(atom->nlocal);
}

/* ----------------------------------------------------------------------
   P u + slip (1 - P) t' = P (u - slip t') + slip t', with t' = (1 - P) t
------------------------------------------------------------------------- */

void TractionFilter::smooth_velocities(double *velocity)
{
  stopwatch_.start();
  force_.resize(atom->nlocal + atom->nghost);
  filter(
      [&](const Kind & /*kind*/, int /*v*/, int i) -> Row {
        return row_of(velocity + 3 * std::size_t(i)) - slip_ * row_of(rough_[i]);
      },
      [&](const Kind & /*kind*/, int /*v*/, int i, const Row &smooth) {
        const Row moves = smooth + slip_ * row_of(rough_[i]);
        std::copy_n(moves.data(), 3, velocity + 3 * std::size_t(i));
      });
  stopwatch_.stop();
}

/* ---------------------------------------------------------------------- */

std::size_t TractionFilter::bytes() const
{
  std::size_t bytes =
      (cells_.capacity() + scratch_.capacity()) * sizeof(TwoRows) + after_.capacity() * sizeof(Row);
  for (const Kind &kind : kinds_)
    bytes += kind.filter.bytes() + (kind.kept.capacity() + kind.lost.capacity()) * sizeof(double);
  return bytes;
}
