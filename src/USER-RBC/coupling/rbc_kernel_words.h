#ifndef LMP_RBC_KERNEL_WORDS_H
#define LMP_RBC_KERNEL_WORDS_H

#include "fluid/spreading.h"
#include "support/rbc_arguments.h"

namespace LAMMPS_NS {

/// Words of the keyword kernel.
inline const Arguments::Choices<fluid::KernelKind> kernel_words = {
    {"peskin4", fluid::KernelKind::peskin4}, {"roma3", fluid::KernelKind::roma3}};

}    // namespace LAMMPS_NS

#endif
