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

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

using namespace LAMMPS_NS;
using rbc::Vec3;

namespace {

/// An atom that is no vertex.
struct LooseAtom {
  double x[3];
  tagint id;
  int type;
};

/// Those of all ranks.
std::vector<LooseAtom> loose_atoms(LAMMPS *lmp, int groupbit)
{
  const Atom *const atom = lmp->atom;
  int vertices = 0;
  for (const CellMembranes *membranes : all_cell_membranes(lmp)) vertices |= membranes->groupbit();
  std::vector<LooseAtom> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & groupbit) && !(atom->mask[i] & vertices))
      mine.push_back({{atom->x[i][0], atom->x[i][1], atom->x[i][2]}, atom->tag[i], atom->type[i]});
  return gather_all(mine, lmp->world);
}

double radius_of(const rbc::SurfaceTemplate &shape)
{
  double radius = 0;
  for (const Vec3 &vertex : shape.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

/// Adds to each point's sum the solid angles of the triangles of cells that count here. Each
/// triangle counts on one rank. Around a cell that one rank has all of, points outside of the box
/// around its vertices are left out: the sum of all triangles would be zero.
void add_solid_angles(const CellMembranes &membranes, const rbc::PointBins &points,
                      std::vector<double> &sums)
{
  const double reach = 2 * radius_of(membranes.shape());
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

}    // namespace

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::warn_of_enclosed_atoms(LAMMPS *lmp, const std::string &style, int groupbit)
{
  const std::vector<CellMembranes *> all = all_cell_membranes(lmp);
  if (all.empty()) return;
  const std::vector<LooseAtom> loose = loose_atoms(lmp, groupbit);
  if (loose.empty()) return;
  const Domain *const domain = lmp->domain;
  const rbc::PackingBox box{
      Vec3(domain->boxlo),
      Vec3(domain->prd),
      {domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0}};
  double radius = 0;
  for (const CellMembranes *membranes : all)
    radius = std::max(radius, radius_of(membranes->shape()));
  rbc::PointBins points(box, 2 * radius);
  for (const LooseAtom &atom : loose) points.add(Vec3(atom.x));

  std::vector<double> sums(loose.size());
  for (const CellMembranes *membranes : all) add_solid_angles(*membranes, points, sums);
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                lmp->world);

  constexpr double HALF_INSIDE = 2 * M_PI;
  std::map<int, int> counts;    // of each type
  tagint first = MAXTAGINT;
  for (std::size_t n = 0; n < loose.size(); ++n) {
    if (sums[n] < HALF_INSIDE) continue;
    ++counts[loose[n].type];
    first = std::min(first, loose[n].id);
  }
  if (counts.empty() || lmp->comm->me != 0) return;
  std::string atoms;
  for (const auto &[type, count] : counts)
    atoms += fmt::format("{}{} atom{} of type {}", atoms.empty() ? "" : ", ", count,
                         count == 1 ? "" : "s", type);
  lmp->error->warning(FLERR,
                      "{} moves {} inside cells (the first has atom ID {}), which cannot leave "
                      "them; create such atoms before rbc/create, which keeps cells off them",
                      style, atoms, first);
}
