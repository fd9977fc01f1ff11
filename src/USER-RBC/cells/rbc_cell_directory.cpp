#include "cells/rbc_cell_directory.h"

#include "atom.h"
#include "cells/rbc_cell_changes.h"
#include "error.h"
#include "fmt/format.h"
#include "support/rbc_first_message.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

CellDirectory::CellDirectory(LAMMPS *lmp, int vertices, int groupbit, std::string style) :
    Pointers(lmp), vertices_(vertices), groupbit_(groupbit), style_(std::move(style)), shares_(lmp)
{
}

void CellDirectory::Extent::include(const Extent &other)
{
  first = std::min(first, other.first);
  last = std::max(last, other.last);
  count += other.count;
}

/* ---------------------------------------------------------------------- */

void CellDirectory::identify()
{
  std::vector<Extent> cells = extents_here();
  std::vector<tagint> ids;
  for (const Extent &cell : cells) ids.push_back(cell.molecule);
  shares_.divide(ids);
  cells = shares_.merge(std::move(cells));

  std::string flaw;
  molecules_.clear();
  first_atoms_.clear();
  for (const Extent &cell : cells) {
    if (flaw.empty()) flaw = flaw_of(cell);
    molecules_.push_back(cell.molecule);
    first_atoms_.push_back(cell.first);
  }
  flaw = first_message(lmp, flaw);
  if (!flaw.empty()) error->all(FLERR, "{}: {}", style_, flaw);

  first_index_ = static_cast<int>(count_before(lmp, molecules_.size()));
  count_ = static_cast<bigint>(molecules_.size());
  MPI_Allreduce(MPI_IN_PLACE, &count_, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (count_ == 0 && !is_fed(lmp, groupbit_))
    error->all(FLERR, "{}: its group has no atoms; define the group after the cells are made",
               style_);
}

/* ----------------------------------------------------------------------
   of the molecules in the group, by the atoms of this rank, in order of molecule ID
------------------------------------------------------------------------- */

std::vector<CellDirectory::Extent> CellDirectory::extents_here() const
{
  std::vector<Extent> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit_)) continue;
    const tagint tag = atom->tag[i];
    const Extent vertex{std::max<tagint>(atom->molecule[i], 0), tag, tag, 1};
    if (!mine.empty() && mine.back().molecule == vertex.molecule)
      mine.back().include(vertex);
    else
      mine.push_back(vertex);
  }
  merge_molecules(mine);
  return mine;
}

std::string CellDirectory::flaw_of(const Extent &cell) const
{
  if (cell.molecule <= 0)
    return fmt::format("{} atoms of the group belong to no molecule", cell.count);
  if (cell.count != vertices_)
    return fmt::format("the cell with molecule ID {} has {} atoms in the group, its template {}",
                       cell.molecule, cell.count, vertices_);
  if (cell.last - cell.first + 1 != vertices_)
    return fmt::format("the atom IDs of the cell with molecule ID {} are not consecutive ({} to "
                       "{})",
                       cell.molecule, cell.first, cell.last);
  return {};
}

/* ---------------------------------------------------------------------- */

std::vector<CellDirectory::Entry> CellDirectory::find(const std::vector<tagint> &molecules) const
{
  std::vector<Entry> found;
  std::vector<int> ranks;
  for (const auto &[molecule, rank] : shares_.ask(molecules)) {
    const auto at = std::lower_bound(molecules_.begin(), molecules_.end(), molecule);
    if (at == molecules_.end() || *at != molecule) continue;
    const auto n = static_cast<int>(at - molecules_.begin());
    found.push_back({molecule, first_atoms_[n], first_index_ + n});
    ranks.push_back(rank);
  }
  return send_elements(lmp, std::move(found), std::move(ranks));
}

/* ---------------------------------------------------------------------- */

CellDirectory::Part CellDirectory::first_incomplete(std::vector<Part> mine) const
{
  for (tagint molecule : molecules_) mine.push_back({molecule, 0});
  Part first{MAXTAGINT, 0};
  for (const Part &cell : shares_.merge(std::move(mine)))
    if (cell.vertices < vertices_) {
      first = cell;
      break;
    }
  const tagint here = first.molecule;
  MPI_Allreduce(MPI_IN_PLACE, &first.molecule, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  if (here != first.molecule) first.vertices = 0;
  MPI_Allreduce(MPI_IN_PLACE, &first.vertices, 1, MPI_INT, MPI_MAX, world);
  return first;
}

/* ---------------------------------------------------------------------- */

double CellDirectory::bytes() const
{
  return static_cast<double>(shares_.bytes() +
                             (molecules_.capacity() + first_atoms_.capacity()) * sizeof(tagint));
}
