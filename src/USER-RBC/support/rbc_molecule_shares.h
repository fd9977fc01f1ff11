#ifndef LMP_RBC_MOLECULE_SHARES_H
#define LMP_RBC_MOLECULE_SHARES_H

#include "lmptype.h"
#include "pointers.h"
#include "support/rbc_sent_elements.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// What the elements of one molecule tell together, in order of molecule ID. Element has a member
/// `molecule` and adds another's part by include().
template <typename Element> void merge_molecules(std::vector<Element> &elements)
{
  std::sort(elements.begin(), elements.end(),
            [](const Element &a, const Element &b) { return a.molecule < b.molecule; });
  std::size_t count = 0;
  for (const Element &element : elements)
    if (count > 0 && elements[count - 1].molecule == element.molecule)
      elements[count - 1].include(element);
    else
      elements[count++] = element;
  elements.resize(count);
}

/// Gives each molecule ID to a rank, IDs that are larger to the same rank or one after it. Ranks
/// get about as many molecules of a scene each, whatever their IDs are.
class MoleculeShares : protected Pointers {
 public:
  explicit MoleculeShares(LAMMPS *lmp) : Pointers(lmp) {}

  /// Collective: divides those of a scene. `mine` are IDs on this rank, ascending.
  void divide(const std::vector<tagint> &mine);

  int rank_of(tagint molecule) const;

  /// A molecule, and the rank that asks for it.
  struct Request {
    tagint molecule;
    int rank;
  };

  /// Collective: this rank asks for molecules. Returns the requests of all ranks for molecules
  /// whose IDs this rank has, in no order.
  std::vector<Request> ask(const std::vector<tagint> &molecules) const;

  /// Collective: sends elements with a member `molecule` to the ranks that have these IDs.
  template <typename Element> std::vector<Element> send(std::vector<Element> elements) const
  {
    std::vector<int> ranks;
    ranks.reserve(elements.size());
    for (const Element &element : elements) ranks.push_back(rank_of(element.molecule));
    return send_elements(lmp, std::move(elements), std::move(ranks));
  }

  /// Collective: the elements of all ranks, merged, of the molecules whose IDs this rank has.
  template <typename Element> std::vector<Element> merge(std::vector<Element> mine) const
  {
    merge_molecules(mine);
    if (lowest_.empty()) return mine;
    mine = send(std::move(mine));
    merge_molecules(mine);
    return mine;
  }

  std::size_t bytes() const { return lowest_.capacity() * sizeof(tagint); }

 private:
  std::vector<tagint> lowest_;    ///< ID of each share, ascending
};

/// Collective: the elements of all ranks, merged. Each molecule is on one rank, those of larger IDs
/// on the same or one after it.
template <typename Element>
std::vector<Element> share_molecules(LAMMPS *lmp, std::vector<Element> mine)
{
  merge_molecules(mine);
  std::vector<tagint> ids;
  ids.reserve(mine.size());
  for (const Element &element : mine) ids.push_back(element.molecule);
  MoleculeShares shares(lmp);
  shares.divide(ids);
  return shares.merge(std::move(mine));
}

/// Collective: the place of each of these molecules in ascending order among those of all ranks,
/// each of which is given once. In no order.
struct MoleculePlace {
  tagint molecule;
  int place;
};
std::vector<MoleculePlace> places_in_order(LAMMPS *lmp, std::vector<tagint> molecules);

/// Collective: how many there are on the ranks before this one.
bigint count_before(LAMMPS *lmp, std::size_t here);

}    // namespace LAMMPS_NS

#endif
