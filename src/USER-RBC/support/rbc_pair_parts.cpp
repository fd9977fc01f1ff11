#include "support/rbc_pair_parts.h"

#include "force.h"
#include "pair.h"

using namespace LAMMPS_NS;

std::vector<StepPart *> LAMMPS_NS::pair_step_parts(Force *force)
{
  constexpr int by_pattern = 0;
  std::vector<StepPart *> parts;
  for (int n = 1;; ++n) {
    auto *const part = dynamic_cast<StepPart *>(force->pair_match("^rbc/", by_pattern, n));
    if (!part || (!parts.empty() && part == parts.back())) return parts;
    parts.push_back(part);
  }
}
