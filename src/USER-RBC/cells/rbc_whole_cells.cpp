#include "cells/rbc_whole_cells.h"

#include "atom.h"
#include "cells/rbc_local_cells.h"
#include "lammps.h"
#include "support/rbc_gather.h"

#include <algorithm>

using namespace LAMMPS_NS;
using rbc::Vec3;

namespace {

struct Head {
  tagint molecule;
  double centre[3];
};

struct Vertex {
  tagint molecule;
  int number;
  double x[3];
};

template <typename Element> bool is_before(const Element &a, const Element &b)
{
  return a.molecule < b.molecule;
}

}    // namespace

std::vector<Vec3> LAMMPS_NS::cell_centres(const LAMMPS *lmp, LocalCells &cells, int vertices)
{
  const auto &local = cells.cells();
  std::vector<double> sums(3 * local.size());
  for (std::size_t c = 0; c < local.size(); ++c)
    for (int v = 0; v < vertices; ++v) {
      if (!local[c].elements->owned[v]) continue;
      const Vec3 x = local[c].position(v, lmp->atom->x);
      for (int d = 0; d < 3; ++d) sums[3 * c + d] += x[d] / vertices;
    }
  cells.sum_shared(sums, 3);
  std::vector<Vec3> centres;
  for (std::size_t c = 0; c < local.size(); ++c) centres.emplace_back(&sums[3 * c]);
  return centres;
}

bool LAMMPS_NS::speaks_for(const LocalCells &cells, std::size_t c)
{
  return cells.cells()[c].elements->owned[0] != 0;
}

std::vector<WholeCell> LAMMPS_NS::whole_cells_on_first(const LAMMPS *lmp, const LocalCells &cells,
                                                       int vertices,
                                                       const std::vector<Vec3> &centres,
                                                       const std::vector<char> &wanted)
{
  std::vector<Head> heads;
  std::vector<Vertex> parts;
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    if (!wanted[c]) continue;
    const LocalCells::Cell &cell = cells.cells()[c];
    const Vec3 &centre = centres[c];
    if (speaks_for(cells, c)) heads.push_back({cell.molecule, {centre[0], centre[1], centre[2]}});
    for (int v = 0; v < vertices; ++v) {
      if (!cell.elements->owned[v]) continue;
      const Vec3 x = cell.position(v, lmp->atom->x);
      parts.push_back({cell.molecule, v, {x[0], x[1], x[2]}});
    }
  }
  heads = gather_on_first(heads, lmp->world);
  parts = gather_on_first(parts, lmp->world);

  std::sort(heads.begin(), heads.end(), is_before<Head>);
  std::sort(parts.begin(), parts.end(), is_before<Vertex>);
  std::vector<WholeCell> whole;
  auto part = parts.begin();
  for (const Head &head : heads) {
    whole.push_back({head.molecule, Vec3(head.centre), std::vector<Vec3>(vertices)});
    for (; part != parts.end() && part->molecule == head.molecule; ++part)
      whole.back().vertices[part->number] = Vec3(part->x);
  }
  return whole;
}
