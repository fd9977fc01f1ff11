#ifndef LMP_RBC_SENT_ELEMENTS_H
#define LMP_RBC_SENT_ELEMENTS_H

#include "comm.h"
#include "irregular.h"
#include "lammps.h"

#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

/// Collective: sends each element to the rank that is given for it. Returns what comes here, in no
/// order. Ranks exchange messages only where they have something for each other.
template <typename Element>
std::vector<Element> send_elements(LAMMPS *lmp, std::vector<Element> elements,
                                   std::vector<int> ranks)
{
  static_assert(std::is_trivially_copyable_v<Element>, "elements are sent as bytes");
  if (lmp->comm->nprocs == 1) return elements;
  Irregular irregular(lmp);
  std::vector<Element> received(
      irregular.create_data(static_cast<int>(elements.size()), ranks.data()));
  irregular.exchange_data(reinterpret_cast<char *>(elements.data()), sizeof(Element),
                          reinterpret_cast<char *>(received.data()));
  irregular.destroy_data();
  return received;
}

}    // namespace LAMMPS_NS

#endif
