#ifndef LMP_RBC_MEMORY_TABLE_H
#define LMP_RBC_MEMORY_TABLE_H

#include "lmptype.h"
#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

/// Where the memory of a scene is: a line for each of LAMMPS's classes, styles of forces, fixes and
/// computes that says of itself what it takes, summed over ranks, ghosts included.
class MemoryTable : protected Pointers {
 public:
  using Pointers::Pointers;

  /// Collective: lines of bytes per vertex, without those of less than a byte.
  std::string table(bigint vertices) const;
};

}    // namespace LAMMPS_NS

#endif
