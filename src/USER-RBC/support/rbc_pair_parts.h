#ifndef LMP_RBC_PAIR_PARTS_H
#define LMP_RBC_PAIR_PARTS_H

#include "support/rbc_step_part.h"

#include <vector>

namespace LAMMPS_NS {

/// The pair styles that take part in steps of fix rbc/ib, those of pair_style hybrid included.
std::vector<StepPart *> pair_step_parts(class Force *force);

}    // namespace LAMMPS_NS

#endif
