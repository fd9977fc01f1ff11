#include "cells/rbc_near_surfaces.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "contact/surface_patches.h"
#include "domain.h"
#include "geometry/tight_vector.h"
#include "neighbor.h"
#include "support/rbc_molecule_shares.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

// edges of triangles may be stretched by this factor

static constexpr double STRETCH = 1.5;

// Part of the slack within which the finder lists triangles. Its lists are much shorter than those
// for the whole slack; it makes them anew when atoms have moved that far.

static constexpr double FINER = 0.15;

namespace {

/// Atom types of a cell.
struct TypeRange {
  tagint molecule;
  int lowest, highest;

  void include(const TypeRange &other)
  {
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
  }
};

/// How many fixes rbc/membrane a cell belongs to.
struct Holders {
  tagint molecule;
  int fixes;

  void include(const Holders &other) { fixes += other.fixes; }
};

}    // namespace

/* ---------------------------------------------------------------------- */

NearSurfaces::NearSurfaces(LAMMPS *lmp, std::string style) :
    Pointers(lmp), style(std::move(style)), stop(std::make_shared<CollectiveStop>(lmp))
{
}

/* ---------------------------------------------------------------------- */

void NearSurfaces::init()
{
  shapes.clear();
  for (CellMembranes *membranes : all_cell_membranes(lmp)) {
    membranes->local_cells().identify();    // the fix itself is initialised later
    const rbc::SurfaceTemplate &surface = membranes->shape();
    std::vector<std::vector<int>> triangles_by_first_vertex(surface.vertex_count());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      triangles_by_first_vertex[surface.triangles[t][0]].push_back(static_cast<int>(t));
    shapes.push_back({membranes, &surface, std::move(triangles_by_first_vertex), {}, {}});
    find_fans(shapes.back());
    if (own_patch > 0) find_own_patches(shapes.back());
  }
  if (shapes.empty())
    error->all(FLERR, "{} needs a fix rbc/membrane: it knows the cells and their triangles", style);
  check_apart();
  take_cells();
}

void NearSurfaces::cells_changed()
{
  check_apart();
}

void NearSurfaces::check_apart() const
{
  if (shapes.size() < 2) return;
  std::vector<Holders> held;
  for (const Shape &shape : shapes)
    for (tagint molecule : shape.membranes->local_cells().all().kept())
      held.push_back({molecule, 1});
  tagint twice = MAXTAGINT;
  for (const Holders &cell : share_molecules(lmp, std::move(held)))
    if (cell.fixes > 1) twice = std::min(twice, cell.molecule);
  MPI_Allreduce(MPI_IN_PLACE, &twice, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  if (twice != MAXTAGINT)
    error->all(FLERR, "{}: molecule ID {} belongs to two fixes rbc/membrane", style, twice);
}

void NearSurfaces::take_cells()
{
  cells.clear();
  place_of_cell.clear();
  bigint before = 0;    // cells of other shapes
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    const LocalCells &local = shapes[n].membranes->local_cells();
    for (const auto &[molecule, cell] : local.known()) {
      const auto number = static_cast<rbc::NearTriangles::Surface>(before + cell.index);
      place_of_cell.insert({molecule, static_cast<int>(cells.size())});
      cells.push_back({static_cast<int>(n), cell.first, number});
    }
    before += local.count();
  }
}

void NearSurfaces::find_fans(Shape &shape) const
{
  std::vector<rbc::NearTriangles::Triangle> all;
  for (const auto &corners : shape.surface->triangles) all.push_back({corners, 0});
  rbc::TriangleFans fans;
  fans.find(all, shape.surface->vertex_count());
  shape.places = fans.places(all);
  shape.fans = fans.triangles.count();
}

void NearSurfaces::find_own_patches(Shape &shape) const
{
  const rbc::SurfaceTemplate &surface = *shape.surface;
  const auto patches = rbc::surface_patches(surface, own_patch);
  bool see_something = false;
  for (const auto &patch : patches) {
    see_something = see_something || patch.size() < surface.triangles.size();
    shape.hidden.emplace_back(surface.triangles.size(), false);
    for (int t : patch) shape.hidden.back()[t] = true;
  }
  shape.fans_see = rbc::fans_that_see(surface, patches, shape.places);
  if (!see_something && comm->me == 0)
    error->warning(FLERR, "{} self: cells are too small to see themselves beyond {:.6g}", style,
                   own_patch);
}

double NearSurfaces::longest_edge() const
{
  double longest = 0;
  for (const Shape &shape : shapes) longest = std::max(longest, shape.surface->longest_edge);
  return STRETCH * longest;
}

/* ---------------------------------------------------------------------- */

int NearSurfaces::cell_of(int i) const
{
  const auto found = place_of_cell.find(atom->molecule[i]);
  if (found == place_of_cell.end()) return NO_CELL;
  const Cell &cell = cells[found->second];
  const tagint vertex = atom->tag[i] - cell.first;    // others may have the same molecule ID
  const int vertices = shapes[cell.shape].surface->vertex_count();
  return vertex >= 0 && vertex < vertices ? found->second : NO_CELL;
}

tagint NearSurfaces::cell_of_mixed_type() const
{
  std::vector<TypeRange> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if (is_vertex(i)) mine.push_back({atom->molecule[i], atom->type[i], atom->type[i]});
  tagint first = MAXTAGINT;
  for (const TypeRange &cell : share_molecules(lmp, std::move(mine)))
    if (cell.lowest != cell.highest) first = std::min(first, cell.molecule);
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  return first == MAXTAGINT ? 0 : first;
}

double NearSurfaces::area(int i) const
{
  const Cell &cell = cells[cell_at[i]];
  return shapes[cell.shape].surface->vertex_area[atom->tag[i] - cell.first];
}

/* ----------------------------------------------------------------------
   Returns the longest edge with which all corners of triangles near an owned vertex are still
   within the ghost cutoff. It is an error if that is below longest_edge().
------------------------------------------------------------------------- */

double NearSurfaces::longest_known_edge(double range, double slack) const
{
  const double ghosts = comm->get_comm_cutoff();
  double longest = ghosts - range - slack;
  if (longest < longest_edge() * (1 - 1e-9))
    error->all(FLERR,
               "{}: ghost cutoff {:.6g} is too short for surfaces {:.6g} apart; use comm_modify "
               "cutoff with at least {:.6g}",
               style, ghosts, range, range + slack + longest_edge());
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int d = 0; d < 3; ++d)
    if (periodic[d]) longest = std::min(longest, domain->prd[d] / 2);
  return longest;
}

void NearSurfaces::build(double range, double slack_of_ghosts, double stale)
{
  ++build_count;
  allowed = slack_of_ghosts / 2;
  built.hold(atom->nlocal > 0 ? atom->x[0] : nullptr, atom->nlocal);
  if (update->whichflag == 0)    // between runs
    for (const Shape &shape : shapes) shape.membranes->local_cells().meet_cells();
  take_cells();
  rbc::resize_tightly(cell_at, atom->nlocal + atom->nghost);
  for (std::size_t i = 0; i < cell_at.size(); ++i) cell_at[i] = cell_of(static_cast<int>(i));
  collect_triangles(longest_known_edge(range, slack_of_ghosts + stale));
  stop->check();
  surfaces.assign(atom->nlocal, rbc::NearTriangles::NO_SURFACE);
  int points = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (cell_at[i] == NO_CELL) continue;
    surfaces[i] = cells[cell_at[i]].number;
    points = i + 1;
  }
  const double travel = 2 * (slack_of_ghosts + 2 * built.error());    // back and forth
  rbc::NearTriangles::SeesOwn seen;
  if (own_patch > 0) seen = [this](int i, int triangle) { return sees_own(i, triangle); };
  finder.build(points, surfaces.data(), atom->nlocal + atom->nghost, atom->x[0], triangles, range,
               FINER * slack_of_ghosts, travel, seen);
}

/* ----------------------------------------------------------------------
   lists all triangles of which this rank has all corners, periodic images included. Each image is
   listed once, by its first corner.
------------------------------------------------------------------------- */

void NearSurfaces::collect_triangles(double longest)
{
  triangles.clear();
  template_triangle.clear();
  triangle_places.clear();
  const int all = atom->nlocal + atom->nghost;
  for (int i = 0; i < all; ++i) {
    if (cell_at[i] == NO_CELL) continue;
    const Cell &cell = cells[cell_at[i]];
    const Shape &shape = shapes[cell.shape];
    for (int t : shape.triangles_by_first_vertex[atom->tag[i] - cell.first]) {
      const auto &corners = shape.surface->triangles[t];
      const int j = image_near(i, cell.first + corners[1], longest);
      const int k = image_near(i, cell.first + corners[2], longest);
      if (j >= 0 && k >= 0 && are_near(j, k, longest)) {
        rbc::push_back_tightly(triangles, rbc::NearTriangles::Triangle{{i, j, k}, cell.number});
        rbc::push_back_tightly(triangle_places, shape.places[t]);
        if (own_patch > 0) template_triangle.push_back(t);
      } else if (i < atom->nlocal)
        stop->report(
            fmt::format("{}: a triangle of the cell with molecule ID {} near ({:.6g}, {:.6g}, "
                        "{:.6g}) has an edge longer than {:.6g} at step {}; it is stretched too "
                        "far, or raise the ghost cutoff {:.6g} with comm_modify cutoff",
                        style, atom->molecule[i], atom->x[i][0], atom->x[i][1], atom->x[i][2],
                        longest, update->ntimestep, comm->get_comm_cutoff()),
            Flaw::stretched);
    }
  }
}

bool NearSurfaces::sees_own(int i, int triangle) const
{
  const Cell &cell = cells[cell_at[i]];
  return !shapes[cell.shape].hidden[atom->tag[i] - cell.first][template_triangle[triangle]];
}

bool NearSurfaces::fans_see(int first, int second) const
{
  const Shape &shape = shapes[cells[cell_at[triangles[first].corner[0]]].shape];
  return shape.fans_see[std::size_t(triangle_places[first].fan) * shape.fans +
                        triangle_places[second].fan] != 0;
}

int NearSurfaces::image_near(int i, tagint id, double longest) const
{
  const int j = domain->closest_image(i, atom->map(id));
  return j >= 0 && are_near(i, j, longest) ? j : -1;
}

bool NearSurfaces::are_near(int i, int j, double longest) const
{
  double square = 0;
  for (int d = 0; d < 3; ++d) {
    const double apart = atom->x[j][d] - atom->x[i][d];
    square += apart * apart;
  }
  return square <= longest * longest;
}

/* ---------------------------------------------------------------------- */

const std::vector<NearSurfaces::Contact> &NearSurfaces::contacts(double range)
{
  report_moved(*stop);
  stop->check();
  return finder.contacts(atom->x[0], range);
}

bool NearSurfaces::report_moved(CollectiveStop &to) const
{
  const double moved = built.largest_displacement(atom->x[0]);
  if (moved <= allowed) return false;
  const int i = built.furthest_moved(atom->x[0]);
  const double *const x = atom->x[i];
  to.report(
      fmt::format("{}: vertices moved by up to {:.4g} since step {}, when their neighbors were "
                  "found, more than {:.6g}, at step {}: cell with molecule ID {} near ({:.6g}, "
                  "{:.6g}, {:.6g}); raise the skin with the neighbor command, or lower the "
                  "timestep",
                  style, moved, neighbor->lastcall, allowed, update->ntimestep, atom->molecule[i],
                  x[0], x[1], x[2]),
      Flaw::unseen_motion);
  return true;
}

/* ---------------------------------------------------------------------- */

double NearSurfaces::bytes() const
{
  double patches = 0;
  for (const Shape &shape : shapes)
    for (const auto &hidden : shape.hidden) patches += sizeof(hidden) + hidden.capacity() / 8.0;
  return static_cast<double>(finder.bytes() + built.bytes()) + patches +
         triangles.capacity() * sizeof(rbc::NearTriangles::Triangle) +
         template_triangle.capacity() * sizeof(int) +
         triangle_places.capacity() * sizeof(rbc::TriangleFans::Place) +
         surfaces.capacity() * sizeof(rbc::NearTriangles::Surface) +
         cells.capacity() * sizeof(Cell) +
         place_of_cell.size() * sizeof(decltype(place_of_cell)::value_type) +
         cell_at.capacity() * sizeof(int);
}
