#include "coupling/rbc_step_cost.h"

#include "fmt/format.h"

#include <algorithm>
#include <mpi.h>
#include <numeric>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void StepCost::start(const std::vector<StepPart *> &parts)
{
  sections_.clear();
  for (StepPart *part : parts)
    for (const StepPart::Section &section : part->sections()) {
      section.stopwatch->reset();
      sections_.push_back(section);
    }
}

/* ---------------------------------------------------------------------- */

std::string StepCost::table(bigint solves, bigint vertices, double cells) const
{
  std::vector<std::string> names;
  std::vector<double> seconds;
  for (const StepPart::Section &section : sections_) {
    const auto found = std::find(names.begin(), names.end(), section.name);
    const std::size_t n = found - names.begin();
    if (found == names.end()) {
      names.push_back(section.name);
      seconds.push_back(0);
    }
    seconds[n] += section.stopwatch->seconds();
  }
  names.emplace_back("Total");
  seconds.push_back(std::accumulate(seconds.begin(), seconds.end(), 0.0));
  MPI_Allreduce(MPI_IN_PLACE, seconds.data(), static_cast<int>(seconds.size()), MPI_DOUBLE, MPI_SUM,
                world);

  std::string text = "Section     | core s/solve | us/vertex | ns/cell | %share\n"
                     "-------------------------------------------------------\n";
  for (std::size_t n = 0; n < names.size(); ++n) {
    const double each = seconds[n] / static_cast<double>(solves);
    text += fmt::format("{:<11} | {:12.5g} | {:9.4g} | {:7.4g} | {:6.2f}\n", names[n], each,
                        vertices > 0 ? each / static_cast<double>(vertices) * 1e6 : 0.0,
                        each / cells * 1e9, 100 * seconds[n] / seconds.back());
  }
  return text;
}
