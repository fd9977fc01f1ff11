#include "cells/rbc_enclosed_atoms.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fmt/format.h"
#include "geometry/point_bins.h"
#include "geometry/solid_angle.h"
#include "support/rbc_gather.h"
#include "support/rbc_sent_elements.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

using namespace LAMMPS_NS;
using rbc::Vec3;

namespace {

/// An atom that is no vertex, on the rank that owns it.
struct LooseAtom {
  double x[3];
  int owner, place;    ///< rank, and place among its loose atoms
};

/// What a rank's triangles add to the solid angle of all cells, seen from an atom.
struct Share {
  int place, from;    ///< from: rank
  double angle;
};

/// Where a rank looks for atoms: in its part of the box, widened by `margin`.
struct Surroundings {
  double lo[3], hi[3];
  double margin;    ///< below 0: nowhere, it has no cells
};

struct LooseAtoms {
  std::vector<LooseAtom> atoms;
  std::vector<tagint> ids;
  std::vector<int> types;
};

LooseAtoms loose_atoms_here(LAMMPS *lmp, int groupbit)
{
  const Atom *const atom = lmp->atom;
  int vertices = 0;
  for (const CellMembranes *membranes : all_cell_membranes(lmp)) vertices |= membranes->groupbit();
  LooseAtoms loose;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit) || (atom->mask[i] & vertices)) continue;
    loose.atoms.push_back({{atom->x[i][0], atom->x[i][1], atom->x[i][2]},
                           lmp->comm->me,
                           static_cast<int>(loose.atoms.size())});
    loose.ids.push_back(atom->tag[i]);
    loose.types.push_back(atom->type[i]);
  }
  return loose;
}

double radius_of(const rbc::SurfaceTemplate &shape)
{
  double radius = 0;
  for (const Vec3 &vertex : shape.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

/// From the centre of a cell, up to which atoms are looked at.
double reach_of(const CellMembranes &membranes)
{
  return 2 * radius_of(membranes.shape());
}

/// A cell's centre is as far from this rank's part of the box as from the cell's nearest vertex
/// here, at most.
Surroundings surroundings_of_cells(LAMMPS *lmp)
{
  Surroundings around{};
  std::copy_n(lmp->domain->sublo, 3, around.lo);
  std::copy_n(lmp->domain->subhi, 3, around.hi);
  around.margin = -1;
  for (const CellMembranes *membranes : all_cell_membranes(lmp)) {
    std::vector<Vec3> x(membranes->shape().vertex_count());
    for (const LocalCells::Cell &cell : membranes->local_cells().cells()) {
      membranes->local_cells().gather(cell, x);
      double nearest = HUGE_VAL;
      for (std::size_t v = 0; v < x.size(); ++v)
        if (cell.elements->owned[v]) nearest = std::min(nearest, x[v].norm());
      around.margin = std::max(around.margin, nearest + reach_of(*membranes));
    }
  }
  return around;
}

/// Whether something between `lo` and `hi`, in the box, has an image there.
bool reaches(const Domain *domain, const Surroundings &around, const double *lo, const double *hi)
{
  for (int d = 0; d < 3; ++d) {
    bool near = false;
    const int images = domain->periodicity[d] ? 1 : 0;
    for (int n = -images; n <= images; ++n) {
      const double shift = n * domain->prd[d];
      near = near || (lo[d] + shift <= around.hi[d] + around.margin &&
                      hi[d] + shift >= around.lo[d] - around.margin);
    }
    if (!near) return false;
  }
  return around.margin >= 0;
}

/// Those that may be near the cells of this rank, from all ranks.
std::vector<LooseAtom> atoms_near_cells(LAMMPS *lmp, const std::vector<LooseAtom> &mine)
{
  const std::vector<Surroundings> all =
      gather_all(std::vector<Surroundings>{surroundings_of_cells(lmp)}, lmp->world);
  Eigen::AlignedBox3d here;
  for (const LooseAtom &atom : mine) here.extend(Vec3(atom.x));
  std::vector<LooseAtom> sent;
  std::vector<int> ranks;
  for (std::size_t rank = 0; rank < all.size() && !mine.empty(); ++rank) {
    if (!reaches(lmp->domain, all[rank], here.min().data(), here.max().data())) continue;
    for (const LooseAtom &atom : mine) {
      if (!reaches(lmp->domain, all[rank], atom.x, atom.x)) continue;
      sent.push_back(atom);
      ranks.push_back(static_cast<int>(rank));
    }
  }
  return send_elements(lmp, std::move(sent), std::move(ranks));
}

/// Adds to each point's sum the solid angles of the triangles of cells that count here. Each
/// triangle counts on one rank. Around a cell that one rank has all of, points outside of the box
/// around its vertices are left out: the sum of all triangles would be zero.
void add_solid_angles(const CellMembranes &membranes, const rbc::PointBins &points,
                      std::vector<double> &sums)
{
  const double reach = reach_of(membranes);
  std::vector<Vec3> x(membranes.shape().vertex_count());
  const LocalCells &cells = membranes.local_cells();
  for (const LocalCells::Cell &cell : cells.cells()) {
    cells.gather(cell, x);
    Eigen::AlignedBox3d around;
    if (!cell.shared)
      for (const Vec3 &vertex : x) around.extend(vertex);
    const rbc::CellElements &elements = *cell.elements;
    points.visit(cell.origin, reach, [&](int point, const Vec3 &image) {
      const Vec3 from = image - cell.origin;
      if (!cell.shared && !around.contains(from)) return;
      for (int t = 0; t < elements.owned_triangles; ++t)
        if (elements.triangle_energy_weight[t] > 0)
          sums[point] +=
              rbc::solid_angle(x[elements.corners[0][t]] - from, x[elements.corners[1][t]] - from,
                               x[elements.corners[2][t]] - from);
    });
  }
}

/// Solid angles of the triangles of all cells here, seen from these atoms.
std::vector<double> solid_angles(LAMMPS *lmp, const std::vector<LooseAtom> &atoms)
{
  const Domain *const domain = lmp->domain;
  const rbc::PackingBox box{
      Vec3(domain->boxlo),
      Vec3(domain->prd),
      {domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0}};
  const std::vector<CellMembranes *> all = all_cell_membranes(lmp);
  double widest = 0;
  for (const CellMembranes *membranes : all) widest = std::max(widest, reach_of(*membranes));
  rbc::PointBins points(box, widest);
  for (const LooseAtom &atom : atoms) points.add(Vec3(atom.x));
  std::vector<double> sums(atoms.size());
  for (const CellMembranes *membranes : all) add_solid_angles(*membranes, points, sums);
  return sums;
}

/// Whether each of this rank's atoms is inside a cell. Only ranks that have cells near an atom know
/// of it, so that no rank has more than what is around its part of the box.
std::vector<char> are_inside(LAMMPS *lmp, const std::vector<LooseAtom> &mine)
{
  const std::vector<LooseAtom> near = atoms_near_cells(lmp, mine);
  const std::vector<double> angles = solid_angles(lmp, near);
  std::vector<Share> shares;
  std::vector<int> ranks;
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (angles[n] == 0) continue;
    shares.push_back({near[n].place, lmp->comm->me, angles[n]});
    ranks.push_back(near[n].owner);
  }
  shares = send_elements(lmp, std::move(shares), std::move(ranks));
  std::sort(shares.begin(), shares.end(), [](const Share &a, const Share &b) {
    return std::tie(a.place, a.from) < std::tie(b.place, b.from);
  });
  std::vector<double> sums(mine.size());
  for (const Share &share : shares) sums[share.place] += share.angle;
  constexpr double HALF_INSIDE = 2 * M_PI;
  std::vector<char> inside;
  for (double sum : sums) inside.push_back(sum >= HALF_INSIDE ? 1 : 0);
  return inside;
}

}    // namespace

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::warn_of_enclosed_atoms(LAMMPS *lmp, const std::string &style, int groupbit)
{
  if (all_cell_membranes(lmp).empty()) return;
  const LooseAtoms loose = loose_atoms_here(lmp, groupbit);
  int any = loose.atoms.empty() ? 0 : 1;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, lmp->world);
  if (!any) return;

  const std::vector<char> inside = are_inside(lmp, loose.atoms);
  std::vector<bigint> counts(lmp->atom->ntypes + 1);
  tagint first = MAXTAGINT;
  for (std::size_t n = 0; n < inside.size(); ++n) {
    if (!inside[n]) continue;
    ++counts[loose.types[n]];
    first = std::min(first, loose.ids[n]);
  }
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()), MPI_LMP_BIGINT,
                MPI_SUM, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LMP_TAGINT, MPI_MIN, lmp->world);
  std::string atoms;
  for (std::size_t type = 1; type < counts.size(); ++type)
    if (counts[type] > 0)
      atoms += fmt::format("{}{} atom{} of type {}", atoms.empty() ? "" : ", ", counts[type],
                           counts[type] == 1 ? "" : "s", type);
  if (atoms.empty() || lmp->comm->me != 0) return;
  lmp->error->warning(FLERR,
                      "{} moves {} inside cells (the first has atom ID {}), which cannot leave "
                      "them; create such atoms before rbc/create, which keeps cells off them",
                      style, atoms, first);
}
