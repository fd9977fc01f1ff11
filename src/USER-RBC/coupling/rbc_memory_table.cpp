#include "coupling/rbc_memory_table.h"

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "fix.h"
#include "fmt/format.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"

#include <algorithm>
#include <mpi.h>
#include <numeric>
#include <vector>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

std::string MemoryTable::table(bigint vertices) const
{
  std::vector<std::string> names{"Atoms", "Communication", "Neighbor lists"};
  std::vector<double> bytes{atom->memory_usage(), comm->memory_usage(), neighbor->memory_usage()};
  const auto add = [&](const std::string &name, double amount) {
    names.push_back(name);
    bytes.push_back(amount);
  };
  if (force->pair) add(fmt::format("pair {}", force->pair_style), force->pair->memory_usage());
  const double of_pair = force->pair ? force->pair->memory_usage() : 0;
  add("other forces", force->memory_usage() - of_pair);
  for (int n = 0; n < modify->nfix; ++n)
    add(fmt::format("fix {}", modify->fix[n]->id), modify->fix[n]->memory_usage());
  for (int n = 0; n < modify->ncompute; ++n)
    add(fmt::format("compute {}", modify->compute[n]->id), modify->compute[n]->memory_usage());
  names.emplace_back("Total");
  bytes.push_back(std::accumulate(bytes.begin(), bytes.end(), 0.0));
  MPI_Allreduce(MPI_IN_PLACE, bytes.data(), static_cast<int>(bytes.size()), MPI_DOUBLE, MPI_SUM,
                world);

  const auto each = [&](std::size_t n) { return bytes[n] / static_cast<double>(vertices); };
  std::size_t widest = 14;
  for (std::size_t n = 0; n < names.size(); ++n)
    if (each(n) >= 1) widest = std::max(widest, names[n].size());
  std::string text =
      fmt::format("{:<{}} | bytes/vertex | %share\n{:->{}}\n", "Memory", widest, "", widest + 24);
  for (std::size_t n = 0; n < names.size(); ++n)
    if (each(n) >= 1)
      text += fmt::format("{:<{}} | {:12.5g} | {:6.2f}\n", names[n], widest, each(n),
                          100 * bytes[n] / bytes.back());
  return text;
}
