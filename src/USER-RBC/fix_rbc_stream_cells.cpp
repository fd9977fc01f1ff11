#include "fix_rbc_stream.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "cells/rbc_whole_cells.h"
#include "comm.h"
#include "coupling/rbc_flow_inside.h"
#include "domain.h"
#include "error.h"
#include "fix_rbc_port.h"
#include "support/rbc_gather.h"
#include "support/rbc_new_atoms.h"
#include "support/rbc_removed_atoms.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::Vec3;

// What fix rbc/stream does to cells. Rank 0 decides which leave and where others appear, so that
// all ranks do the same.

// cells owed, of those that belong into the region, from which on a warning tells of it

static constexpr double LONG_DELAY = 0.5, LEAST_DELAY = 3;

/* ----------------------------------------------------------------------
   Positions are those of the end of the step. Where cells change, neighbors are found anew.
------------------------------------------------------------------------- */

void FixRBCStream::post_integrate()
{
  leavers.clear();
  arrivals.clear();
  if (update->ntimestep % every != 0) return;
  leavers = find_leavers();
  if (ledger->due() > 0) arrivals = find_places();
  if (!leavers.empty() || !arrivals.empty()) next_reneighbor = update->ntimestep;
}

void FixRBCStream::pre_exchange()
{
  if (next_reneighbor != update->ntimestep) return;
  note_ids();
  if (!leavers.empty()) remove_leavers();
  if (!arrivals.empty()) add_arrivals();
  tell_of_changed_cells(lmp);
}

/* ----------------------------------------------------------------------
   cells whose centre lies in the region of an outlet
------------------------------------------------------------------------- */

std::vector<FixRBCStream::Leaver> FixRBCStream::find_leavers() const
{
  std::vector<Leaver> found;
  if (outlets.empty()) return found;
  const LocalCells &cells = membranes->local_cells();
  const std::vector<Vec3> centres = centres_on_first(lmp, cells, shape->vertex_count());
  for (std::size_t c = 0; c < centres.size(); ++c)
    for (std::size_t n = 0; n < outlets.size(); ++n) {
      const RegionEnclosure end(domain->get_region_by_id(outlets[n].region), domain);
      if (!end.contains(centres[c])) continue;
      found.push_back({cells.molecules()[c], static_cast<int>(n)});
      break;
    }
  return gather_all(found, world);    // those of rank 0
}

/* ----------------------------------------------------------------------
   the periodic image next to where cells appear
------------------------------------------------------------------------- */

Vec3 FixRBCStream::near_feed(const Vec3 &x) const
{
  Vec3 shift = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (domain->periodicity[d])
      shift[d] = std::round((x[d] - feed_lo[d] - feed_length[d] / 2) / domain->prd[d]);
  return x - shift.cwiseProduct(Vec3(domain->prd));
}

void FixRBCStream::collect_obstacles()
{
  placement->clear();
  for (CellMembranes *cells : all_cell_membranes(lmp)) add_surfaces(*cells);
  add_points();
}

/* ----------------------------------------------------------------------
   cells near the region
------------------------------------------------------------------------- */

void FixRBCStream::add_surfaces(CellMembranes &others)
{
  const int size = others.shape().vertex_count();
  const std::vector<Vec3> centres = centres_on_first(lmp, others.local_cells(), size);
  const double reach = placement->reach() + 2 * std::sqrt(others.shape().area);
  std::vector<char> wanted(centres.size());
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const Vec3 from = near_feed(centres[c]) - feed_lo;
    wanted[c] = ((from.array() > -reach) && (from.array() < feed_length.array() + reach)).all();
  }
  auto surfaces = vertices_on_first(lmp, others.local_cells(), size, std::move(wanted));
  for (std::vector<Vec3> &vertices : surfaces) {
    Vec3 centre = Vec3::Zero();
    for (const Vec3 &vertex : vertices) centre += vertex / size;
    const Vec3 shift = near_feed(centre) - centre;
    for (Vec3 &vertex : vertices) vertex += shift;
    placement->avoid_surface({std::move(vertices), &others.shape().triangles});
  }
}

/* ----------------------------------------------------------------------
   atoms of walls and others that belong to no cell
------------------------------------------------------------------------- */

void FixRBCStream::add_points()
{
  int of_cells = 0;
  for (const CellMembranes *cells : all_cell_membranes(lmp)) of_cells |= cells->groupbit();
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (atom->mask[i] & of_cells) continue;
    const Vec3 x = near_feed(Vec3(atom->x[i])), from = x - feed_lo;
    if ((from.array() > -gap).all() && (from.array() < feed_length.array() + gap).all())
      mine.insert(mine.end(), x.data(), x.data() + 3);
  }
  const std::vector<double> all = gather_on_first(mine, world);
  for (std::size_t i = 0; i < all.size(); i += 3) placement->avoid_point(Vec3(&all[i]));
}

/* ----------------------------------------------------------------------
   for as many of the cells that are due as there is room for
------------------------------------------------------------------------- */

std::vector<rbc::CellPlacement::Place> FixRBCStream::find_places()
{
  collect_obstacles();
  std::vector<rbc::CellPlacement::Place> found;
  for (int n = ledger->due(); n > 0 && comm->me == 0; --n) {
    const auto place = placement->find(attempts);
    if (!place) break;
    found.push_back(*place);
  }
  auto drawn = static_cast<bigint>(placement->drawn());
  MPI_Bcast(&drawn, 1, MPI_LMP_BIGINT, 0, world);
  placement->set_drawn(drawn);
  std::vector<double> numbers;
  for (const auto &place : found) {
    numbers.insert(numbers.end(), place.centre.data(), place.centre.data() + 3);
    numbers.insert(numbers.end(), place.rotation.data(), place.rotation.data() + 9);
  }
  numbers = gather_all(numbers, world);    // those of rank 0
  found.clear();
  for (std::size_t n = 0; n < numbers.size(); n += 12)
    found.push_back({Vec3(&numbers[n]), Eigen::Matrix3d(&numbers[n + 3])});
  if (found.empty()) warn_of_delay();
  return found;
}

void FixRBCStream::warn_of_delay()
{
  if (warned || ledger->owed() < std::max(LEAST_DELAY, LONG_DELAY * room)) return;
  warned = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   "{}: {:.3g} cells are owed at step {}, for which there is no room in region "
                   "{}: make it longer or wider, or use more attempts than {}, a smaller overlap "
                   "than {:.4g} or a lower hematocrit than {:.4g}",
                   style, ledger->owed(), update->ntimestep, region, attempts, gap, hematocrit);
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::remove_leavers()
{
  std::vector<tagint> molecules;
  for (const Leaver &leaver : leavers) molecules.push_back(leaver.molecule);
  std::sort(molecules.begin(), molecules.end());
  std::vector<char> marked(atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i)
    marked[i] = (atom->mask[i] & groupbit) &&
                std::binary_search(molecules.begin(), molecules.end(), atom->molecule[i]);
  remove_atoms(lmp, std::move(marked));
  for (const Leaver &leaver : leavers) ledger->let_out(leaver.outlet);
}

/* ----------------------------------------------------------------------
   the highest ones that there have been
------------------------------------------------------------------------- */

void FixRBCStream::note_ids()
{
  for (int i = 0; i < atom->nlocal; ++i) {
    last_atom = std::max(last_atom, atom->tag[i]);
    last_molecule = std::max(last_molecule, atom->molecule[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, &last_atom, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, &last_molecule, 1, MPI_LMP_TAGINT, MPI_MAX, world);
}

/* ----------------------------------------------------------------------
   with IDs that no cell has had before
------------------------------------------------------------------------- */

void FixRBCStream::add_arrivals()
{
  const int size = shape->vertex_count();
  if (last_molecule > MAXTAGINT - static_cast<tagint>(arrivals.size()))
    error->all(FLERR, "{}: no molecule IDs are left beyond {}, the largest", style, last_molecule);

  NewAtoms atoms(lmp, style, static_cast<bigint>(arrivals.size()) * size, last_atom);
  for (const auto &place : arrivals) {
    ++last_molecule;
    for (int v = 0; v < size; ++v) {
      const NewAtoms::Made made =
          atoms.add(cell_type, place.centre + place.rotation * shape->vertices[v]);
      if (made.index < 0) continue;
      atom->molecule[made.index] = last_molecule;
      atom->image[made.index] = made.image;
      atom->mask[made.index] |= groupbit;
    }
  }
  atoms.finish();
  ledger->let_in(static_cast<int>(arrivals.size()));
}
