#include "cells/rbc_whole_cells.h"

#include "atom.h"
#include "cells/rbc_local_cells.h"
#include "comm.h"
#include "lammps.h"
#include "support/rbc_gather.h"

using namespace LAMMPS_NS;
using rbc::Vec3;

namespace {

struct Vertex {
  int cell, number;
  double x[3];
};

/// Calls visit(cell, vertex, place) for each vertex that this rank owns.
template <typename Visit>
void visit_owned(const LocalCells &cells, int vertices, const double *const *x, Visit visit)
{
  for (const LocalCells::Cell &cell : cells.cells())
    for (int v = 0; v < vertices; ++v)
      if (cell.elements->owned[v]) visit(cell.index, v, cell.position(v, x));
}

}    // namespace

std::vector<Vec3> LAMMPS_NS::centres_on_first(LAMMPS *lmp, const LocalCells &cells, int vertices)
{
  const std::size_t count = cells.molecules().size();
  std::vector<double> mine(3 * count), sums(mine.size());
  visit_owned(cells, vertices, lmp->atom->x, [&](int cell, int, const Vec3 &x) {
    for (int d = 0; d < 3; ++d) mine[3 * cell + d] += x[d] / vertices;
  });
  MPI_Reduce(mine.data(), sums.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, 0,
             lmp->world);
  std::vector<Vec3> centres;
  if (lmp->comm->me == 0)
    for (std::size_t c = 0; c < count; ++c) centres.emplace_back(&sums[3 * c]);
  return centres;
}

std::vector<std::vector<Vec3>> LAMMPS_NS::vertices_on_first(LAMMPS *lmp, const LocalCells &cells,
                                                            int vertices, std::vector<char> wanted)
{
  wanted.resize(cells.molecules().size());
  MPI_Bcast(wanted.data(), static_cast<int>(wanted.size()), MPI_CHAR, 0, lmp->world);
  std::vector<Vertex> mine;
  visit_owned(cells, vertices, lmp->atom->x, [&](int cell, int v, const Vec3 &x) {
    if (wanted[cell]) mine.push_back({cell, v, {x[0], x[1], x[2]}});
  });
  const std::vector<Vertex> all = gather_on_first(mine, lmp->world);

  std::vector<std::vector<Vec3>> found;
  if (lmp->comm->me != 0) return found;
  std::vector<int> place(wanted.size(), -1);
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    if (!wanted[c]) continue;
    place[c] = static_cast<int>(found.size());
    found.emplace_back(vertices);
  }
  for (const Vertex &vertex : all) found[place[vertex.cell]][vertex.number] = Vec3(vertex.x);
  return found;
}
