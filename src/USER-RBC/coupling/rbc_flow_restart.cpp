#include "coupling/rbc_flow_restart.h"

#include "comm.h"
#include "domain.h"
#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {

/// 0 without plates, 1 with plates without slip as in files of before plates could slip.
double plates(const fluid::Grid &grid)
{
  const auto &[lower, upper] = grid.plate_conditions;
  return grid.plates ? 1 + int(lower) + 16 * int(upper) : 0;
}

/// What a flow without inertia remembers. A file of another kind of memory must have another
/// number.
constexpr double STEADY_MEMORY = -1;

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<double> FlowRestart::head(const fluid::Flow &flow) const
{
  const auto &cells = flow.grid().cells;
  return {double(cells[0]),
          double(cells[1]),
          double(cells[2]),
          domain->prd[0],
          domain->prd[1],
          domain->prd[2],
          plates(flow.grid()),
          double(flow.equations().inertia),
          double(flow.equations().scheme),
          double(flow.history_length())};
}

double FlowRestart::bytes(const fluid::Flow &flow) const
{
  return sizeof(double) * (head(flow).size() + 1.0 + flow.history_length());
}

/* ---------------------------------------------------------------------- */

void FlowRestart::check_size(const fluid::Flow &flow) const
{
  if (bytes(flow) <= MAXSMALLINT) return;
  const auto &cells = flow.grid().cells;
  error->all(FLERR,
             "{}: the history of {} x {} x {} cells, {:.3g} bytes, does not fit into a restart "
             "file, which holds 2 GB of it",
             style_, cells[0], cells[1], cells[2], bytes(flow));
}

/* ---------------------------------------------------------------------- */

void FlowRestart::write(FILE *fp, fluid::Flow &flow, bigint solves) const
{
  check_size(flow);
  const std::vector<double> history = flow.history();
  if (comm->me != 0) return;
  std::vector<double> first = head(flow);
  first.push_back(double(solves));
  const int size = static_cast<int>(bytes(flow));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(first.data(), sizeof(double), first.size(), fp);
  fwrite(history.data(), sizeof(double), history.size(), fp);
}

/* ---------------------------------------------------------------------- */

bigint FlowRestart::restore(const char *buffer, fluid::Flow &flow) const
{
  const auto found = reinterpret_cast<const double *>(buffer);
  const std::vector<double> expected = head(flow);
  if (!std::equal(expected.begin(), expected.end(), found))
    error->all(
        FLERR,
        "{}: the restart file holds this flow on a grid of {} {} {} cells, or in another "
        "box, or with other plates or another inertia or scheme; define the fix as it was, or "
        "use another fix ID to start from rest",
        style_, found[0], found[1], found[2]);
  flow.restore(found + expected.size() + 1);
  return static_cast<bigint>(found[expected.size()]);
}

/* ---------------------------------------------------------------------- */

bool FlowRestart::is_of_steady_flow(const char *buffer)
{
  return *reinterpret_cast<const double *>(buffer) < 0;
}

void FlowRestart::write_memory(FILE *fp, const std::vector<double> &memory) const
{
  if (comm->me != 0) return;
  const double first[2] = {STEADY_MEMORY, static_cast<double>(memory.size())};
  const int size = static_cast<int>((2 + memory.size()) * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(first, sizeof(double), 2, fp);
  fwrite(memory.data(), sizeof(double), memory.size(), fp);
}

std::vector<double> FlowRestart::read_memory(const char *buffer) const
{
  const auto found = reinterpret_cast<const double *>(buffer);
  if (found[0] != STEADY_MEMORY)
    error->all(FLERR,
               "{}: the restart file is of a later version of this package, which keeps other "
               "numbers of walls and flow rates; use that version, or another fix ID to start "
               "without them",
               style_);
  return {found + 2, found + 2 + static_cast<std::size_t>(found[1])};
}
