#include "fix_rbc_stream.h"

#include "atom.h"
#include "cells/rbc_cell_membranes.h"
#include "cells/rbc_whole_cells.h"
#include "comm.h"
#include "coupling/rbc_flow_inside.h"
#include "domain.h"
#include "dump.h"
#include "error.h"
#include "fix_rbc_port.h"
#include "modify.h"
#include "output.h"
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

// cells owed from which on one appears at random, without a periodic stretch and with it

static constexpr double DUE = 0.5, BEHIND = 2;

/* ----------------------------------------------------------------------
   Positions are those of the end of the step. Where cells change, neighbors are found anew.
------------------------------------------------------------------------- */

void FixRBCStream::post_integrate()
{
  leavers.clear();
  arrivals.clear();
  copies.clear();
  const bool looks = update->ntimestep % every == 0;
  if (looks) {
    std::vector<Vec3> centres;
    if (stretch || !outlets.empty()) centres = centres_here();
    leavers = find_leavers(centres);
    if (stretch) follow(centres);
  }
  const bool due = looks && is_due();
  if (due || leads()) collect_obstacles();
  if (leads()) lead_copies();
  if (due) arrivals = find_arrivals();
  if (!leavers.empty() || !arrivals.empty()) next_reneighbor = update->ntimestep;
}

std::vector<Vec3> FixRBCStream::centres_here() const
{
  return cell_centres(lmp, membranes->local_cells(), shape->vertex_count());
}

/* ----------------------------------------------------------------------
   Dumps take IDs that are consecutive at the start of a run for consecutive to its end, and write
   beyond their memory where as many others are there.
------------------------------------------------------------------------- */

void FixRBCStream::pre_exchange()
{
  if (next_reneighbor != update->ntimestep) return;
  const bool consecutive = atom->tag_consecutive() != 0;
  note_ids();
  if (!leavers.empty()) remove_leavers();
  if (!arrivals.empty()) add_arrivals();
  tell_of_changed_cells(lmp);
  if (!consecutive) return;
  for (Dump *dump : output->get_dump_list()) dump->init();
}

/* ----------------------------------------------------------------------
   cells whose centre lies in the region of an outlet
------------------------------------------------------------------------- */

std::vector<FixRBCStream::Leaver> FixRBCStream::find_leavers(const std::vector<Vec3> &centres) const
{
  std::vector<Leaver> found;
  if (outlets.empty()) return found;
  std::vector<RegionEnclosure> ends;
  for (const Outlet &outlet : outlets)
    ends.emplace_back(domain->get_region_by_id(outlet.region), domain);
  const LocalCells &cells = membranes->local_cells();
  for (std::size_t c = 0; c < centres.size(); ++c) {
    if (!speaks_for(cells, c)) continue;
    const auto end = std::find_if(ends.begin(), ends.end(),
                                  [&](const auto &region) { return region.contains(centres[c]); });
    if (end != ends.end())
      found.push_back({cells.cells()[c].molecule, static_cast<int>(end - ends.begin())});
  }
  found = gather_all(found, world);
  std::sort(found.begin(), found.end(),
            [](const Leaver &a, const Leaver &b) { return a.molecule < b.molecule; });
  return found;
}

/* ----------------------------------------------------------------------
   how many cells are owed when one is drawn at random; whether there is something to do
------------------------------------------------------------------------- */

double FixRBCStream::late() const
{
  return stretch ? BEHIND : DUE;
}

bool FixRBCStream::is_due() const
{
  return ledger->owed() >= late() || (stretch && !stretch->waiting().empty());
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
  noted.clear();
  for (CellMembranes *cells : all_cell_membranes(lmp)) add_surfaces(*cells);
  add_arrivals_of_others();
}

/* ----------------------------------------------------------------------
   what other fixes rbc/stream, whose turn came before, will add in this step
------------------------------------------------------------------------- */

void FixRBCStream::add_arrivals_of_others()
{
  for (Fix *fix : modify->get_fix_by_style("^rbc/stream$")) {
    const auto *const other = dynamic_cast<FixRBCStream *>(fix);
    if (other == this) return;
    for (std::vector<Vec3> vertices : other->arrivals) {
      const Vec3 shift = near_feed(vertices[0]) - vertices[0];
      for (Vec3 &vertex : vertices) vertex += shift;
      placement->avoid_surface({std::move(vertices), &other->shape->triangles});
    }
  }
}

/* ----------------------------------------------------------------------
   cells near the region
------------------------------------------------------------------------- */

void FixRBCStream::add_surfaces(CellMembranes &others)
{
  const int size = others.shape().vertex_count();
  const std::vector<Vec3> centres = cell_centres(lmp, others.local_cells(), size);
  const double reach = placement->reach() + 2 * std::sqrt(others.shape().area);
  std::vector<char> wanted(centres.size());
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const Vec3 from = near_feed(centres[c]) - feed_lo;
    wanted[c] = ((from.array() > -reach) && (from.array() < feed_length.array() + reach)).all();
  }
  for (WholeCell &cell : whole_cells_on_first(lmp, others.local_cells(), size, centres, wanted)) {
    const Vec3 shift = near_feed(cell.centre) - cell.centre;
    for (Vec3 &vertex : cell.vertices) vertex += shift;
    if (stretch && &others == membranes && note_cell(cell)) continue;
    placement->avoid_surface({std::move(cell.vertices), &others.shape().triangles});
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

std::vector<std::vector<Vec3>> FixRBCStream::find_arrivals()
{
  std::vector<std::vector<Vec3>> found;
  if (stretch) add_copies(found);
  if (ledger->owed() >= late()) {
    add_points();
    if (comm->me == 0) add_random(found);
  }
  auto drawn = static_cast<bigint>(placement->drawn());
  MPI_Bcast(&drawn, 1, MPI_LMP_BIGINT, 0, world);
  placement->set_drawn(drawn);
  share(found);
  if (found.size() == copies.size()) warn_of_delay();
  return found;
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::add_random(std::vector<std::vector<Vec3>> &found)
{
  for (double owed = ledger->owed(); owed >= late(); --owed) {
    const auto place = placement->find(attempts);
    if (!place) return;
    found.emplace_back();
    for (const Vec3 &vertex : shape->vertices)
      found.back().push_back(place->centre + place->rotation * vertex);
  }
}

/* ----------------------------------------------------------------------
   what rank 0 has found
------------------------------------------------------------------------- */

void FixRBCStream::share(std::vector<std::vector<Vec3>> &found) const
{
  std::vector<double> numbers;
  for (const std::vector<Vec3> &vertices : found)
    for (const Vec3 &vertex : vertices)
      numbers.insert(numbers.end(), vertex.data(), vertex.data() + 3);
  numbers = gather_all(numbers, world);
  found.assign(numbers.size() / (3 * shape->vertices.size()), {});
  auto next = numbers.begin();
  for (std::vector<Vec3> &vertices : found)
    for (int v = 0; v < shape->vertex_count(); ++v, next += 3) vertices.emplace_back(&*next);
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::warn_of_delay()
{
  if (warned || ledger->owed() < std::max(LEAST_DELAY, LONG_DELAY * room)) return;
  warned = true;
  if (comm->me != 0) return;
  const std::string help =
      stretch ? "make it longer, or at the start fill it and what is behind it denser, or use"
              : fmt::format("make it longer or wider, or use more attempts than {},", attempts);
  error->warning(FLERR,
                 "{}: {:.3g} cells are owed at step {}, for which there is no room in region {}: "
                 "{} a smaller overlap than {:.4g} or a lower hematocrit than {:.4g}",
                 style, ledger->owed(), update->ntimestep, region, help, gap, hematocrit);
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
  for (const Leaver &leaver : leavers)
    if (leaver.outlet >= 0) ledger->let_out(leaver.outlet);
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

  note_copies();
  NewAtoms atoms(lmp, style, static_cast<bigint>(arrivals.size()) * size, last_atom);
  for (const std::vector<Vec3> &vertices : arrivals) {
    ++last_molecule;
    for (const Vec3 &vertex : vertices) {
      const NewAtoms::Made made = atoms.add(cell_type, vertex);
      if (made.index < 0) continue;
      atom->molecule[made.index] = last_molecule;
      atom->image[made.index] = made.image;
      atom->mask[made.index] |= groupbit | moved_groupbit;
    }
  }
  atoms.finish();
  ledger->let_in(static_cast<int>(arrivals.size() - copies.size()));
}
