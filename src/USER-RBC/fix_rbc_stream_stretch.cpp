#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "cells/rbc_whole_cells.h"
#include "comm.h"
#include "domain.h"
#include "fix_rbc_stream.h"
#include "modify.h"
#include "support/rbc_gather.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::Vec3;

// What fix rbc/stream does with a periodic stretch. All ranks know it, rank 0 the shapes of cells.

// what copies that are led keep from others, of the gap that cells keep where they appear

static constexpr double NEARER = 0.25;

// places that are tried for a copy along the lead

static constexpr int PLACES = 40;

/* ----------------------------------------------------------------------
   where cells are along it
------------------------------------------------------------------------- */

void FixRBCStream::follow(const std::vector<Vec3> &centres)
{
  const LocalCells &local = membranes->local_cells();
  std::vector<rbc::PeriodicStretch::Cell> cells;
  for (std::size_t c = 0; c < centres.size(); ++c) {
    if (!speaks_for(local, c)) continue;
    const rbc::PeriodicStretch::Cell cell{local.cells()[c].molecule, place_along(centres[c]),
                                          is_beside(centres[c])};
    if (!stretch->is_elsewhere(cell)) cells.push_back(cell);
  }
  ledger->let_in(stretch->follow(gather_all(cells, world), ledger->owed()));
  for (std::int64_t id : stretch->retired()) leavers.push_back({static_cast<tagint>(id), -1});
  if (!stretch->waiting().empty() && stretch->is_overfull(ledger->owed()))
    stretch->skip(stretch->waiting().back().id);
}

double FixRBCStream::place_along(const Vec3 &centre) const
{
  const double from = (near_feed(centre) - feed_lo)[along];
  return upwards ? from : feed_length[along] - from;
}

bool FixRBCStream::is_beside(const Vec3 &centre) const
{
  const Vec3 from = near_feed(centre) - feed_lo;
  bool beside = false;
  for (int d = 0; d < 3; ++d)
    if (d != along) beside = beside || from[d] < 0 || from[d] > feed_length[d];
  return beside;
}

/* ----------------------------------------------------------------------
   Notes the vertices of a copy that is led, and of a cell that has one or should have one. Returns
   whether it is such a copy, whose place follows from that of its cell.
------------------------------------------------------------------------- */

bool FixRBCStream::note_cell(const WholeCell &cell)
{
  bool counts = false, led = false;
  for (const auto &copy : stretch->led()) {
    led = led || copy.id == cell.molecule;
    counts = counts || copy.cell == cell.molecule;
  }
  for (const auto &other : stretch->waiting()) counts = counts || other.id == cell.molecule;
  if (counts || led) noted[cell.molecule] = cell.vertices;
  return led;
}

/* ----------------------------------------------------------------------
   where the copy of a cell belongs; on rank 0
------------------------------------------------------------------------- */

std::vector<Vec3> FixRBCStream::behind(tagint cell, double shift) const
{
  std::vector<Vec3> vertices = noted.at(cell);
  const double back = stretch->loop() + shift;
  for (Vec3 &vertex : vertices) vertex[along] -= upwards ? back : -back;
  return vertices;
}

/* ----------------------------------------------------------------------
   Puts copies behind their cells, and lets those go that would touch others there. Copies of one
   shift are as far from each other as their cells. Velocities at the end of the step that are known
   already are those of other places.
------------------------------------------------------------------------- */

void FixRBCStream::lead_copies()
{
  const std::vector<rbc::PeriodicStretch::Copy> led = stretch->led();
  std::vector<std::vector<Vec3>> shapes;
  std::vector<int> free;
  if (comm->me == 0)
    for (std::size_t n = 0; n < led.size(); ++n) {
      const auto &[cell, copy, shift] = led[n];
      shapes.push_back(behind(static_cast<tagint>(cell), shift));
      const bool fits = placement->fits(shapes.back(), NEARER * gap, shift);
      if (!fits) {
        free.push_back(static_cast<int>(n));
        placement->avoid_surface({noted.at(static_cast<tagint>(copy)), &shape->triangles});
      } else
        placement->avoid_surface({shapes.back(), &shape->triangles}, shift);
    }
  share(shapes);
  std::map<tagint, const std::vector<Vec3> *> places;
  for (std::size_t n = 0; n < led.size(); ++n) places[static_cast<tagint>(led[n].id)] = &shapes[n];
  for (int n : gather_all(free, world)) {
    places.erase(static_cast<tagint>(led[n].id));
    stretch->let_go(led[n].cell);
  }
  move_copies(places);
}

void FixRBCStream::move_copies(const std::map<tagint, const std::vector<Vec3> *> &places)
{
  for (const LocalCells::Cell &cell : membranes->local_cells().cells()) {
    const auto place = places.find(cell.molecule);
    if (place == places.end()) continue;
    for (int v = 0; v < shape->vertex_count(); ++v) {
      if (!cell.elements->owned[v]) continue;
      const Vec3 move = nearest_image((*place->second)[v] - cell.position(v, atom->x));
      for (int d = 0; d < 3; ++d) atom->x[cell.atom[v]][d] += move[d];
    }
  }
  for (Fix *fix : modify->get_fix_by_style("^rbc/ib$"))
    dynamic_cast<CellWatcher *>(fix)->cells_changed();
}

Vec3 FixRBCStream::nearest_image(Vec3 x) const
{
  for (int d = 0; d < 3; ++d)
    if (domain->periodicity[d]) x[d] -= domain->prd[d] * std::round(x[d] / domain->prd[d]);
  return x;
}

/* ----------------------------------------------------------------------
   for cells that wait, where there is room: a loop behind them, or a little more
------------------------------------------------------------------------- */

void FixRBCStream::add_copies(std::vector<std::vector<Vec3>> &found)
{
  std::vector<rbc::PeriodicStretch::Copy> started;
  if (comm->me == 0)
    for (const auto &cell : stretch->waiting())
      for (double shift : stretch->shifts(cell, PLACES)) {
        std::vector<Vec3> place = behind(static_cast<tagint>(cell.id), shift);
        if (!placement->fits(place, gap, shift)) continue;
        placement->avoid_surface({place, &shape->triangles}, shift);
        found.push_back(std::move(place));
        started.push_back({cell.id, 0, shift});
        break;
      }
  copies = gather_all(started, world);
}

/* ----------------------------------------------------------------------
   The first ones of the new cells are copies, which now get their molecule IDs.
------------------------------------------------------------------------- */

void FixRBCStream::note_copies()
{
  tagint id = last_molecule;
  for (const auto &[cell, none, shift] : copies) stretch->copied({cell, ++id, shift});
}
