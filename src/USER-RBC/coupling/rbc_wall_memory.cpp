// The part of RigidWalls that keeps what is known of walls: over evaluations that are taken back,
// and in restart files.

#include "coupling/rbc_rigid_walls.h"

#include "comm.h"
#include "support/rbc_gather.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;

namespace {

/// Numbers before those of the markers: the flow that forces and directions belong to, markers,
/// numbers of each, numbers that all share.
constexpr std::size_t FLOW = 10, HEAD = FLOW + 3;

/// Kernel and kind in one number, which for points is the one that older files have.
double marker_key(const WallGroup::Settings &settings)
{
  constexpr int SHEETS = 16;    // beyond all kernels
  return static_cast<int>(settings.kernel) +
         (settings.kind == fluid::MarkerKind::sheets ? SHEETS : 0);
}

std::vector<double> flow_key(const fluid::Flow &flow, const WallGroup &first, bool free_mean)
{
  const fluid::Grid &grid = flow.grid();
  return {double(grid.cells[0]),
          double(grid.cells[1]),
          double(grid.cells[2]),
          grid.spacing[0],
          grid.spacing[1],
          grid.spacing[2],
          double(grid.plates),
          flow.equations().viscosity,
          marker_key(first.settings()),
          double(free_mean)};
}

}    // namespace

/* ---------------------------------------------------------------------- */

void RigidWalls::hold(const fluid::Flow &flow)
{
  find_markers(flow);
  surface_.hold();
}

void RigidWalls::restore()
{
  surface_.restore();
  give_forces();
}

/* ---------------------------------------------------------------------- */

std::vector<double> RigidWalls::memory(const fluid::Flow &flow, std::size_t most)
{
  if (!remembered_.empty()) return comm->me == 0 ? remembered_ : std::vector<double>();
  if (!surface_is_set_) return {};
  bigint mine = surface_.count(), count;
  MPI_Allreduce(&mine, &count, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const auto numbers = [&](bool directions) {
    return HEAD + surface_.shared_memory(directions).size() +
           std::size_t(count) * (1 + surface_.memory_of_marker(directions));
  };
  const bool directions = numbers(true) <= most;
  if (!directions) surface_.forget_directions();
  if (numbers(directions) > most) {
    forget();
    return {};
  }

  const std::size_t each = surface_.memory_of_marker(directions);
  const std::vector<double> of_markers = surface_.marker_memory(directions);
  std::vector<double> rows;
  rows.reserve(tags_.size() * (1 + each));
  for (std::size_t n = 0; n < tags_.size(); ++n) {
    rows.push_back(static_cast<double>(tags_[n]));
    rows.insert(rows.end(), &of_markers[n * each], &of_markers[n * each] + each);
  }
  const std::vector<double> all = gather_on_first(rows, world);
  if (comm->me != 0) return {};

  // times from the end of the step on, as the next run counts them
  const fluid::RigidSurface::Times times = surface_.times();
  surface_.shift_times(span_);
  const std::vector<double> shared = surface_.shared_memory(directions);
  surface_.set_times(times);
  std::vector<double> memory = flow_key(flow, *first(), surface_.settings().free_mean);
  memory.insert(memory.end(), {double(count), double(each), double(shared.size())});
  memory.insert(memory.end(), shared.begin(), shared.end());
  memory.insert(memory.end(), all.begin(), all.end());
  return memory;
}

void RigidWalls::forget()
{
  surface_is_set_ = false;
  for (const Marker &marker : markers_)
    std::fill_n(walls_[marker.wall]->forces(marker.atom), WallGroup::NUMBERS, 0.0);
}

/* ----------------------------------------------------------------------
   Takes what a restart file has for these markers; returns false if it has nothing, or is of other
   walls or of another flow.
------------------------------------------------------------------------- */

bool RigidWalls::set_remembered(const fluid::Flow &flow)
{
  if (remembered_.empty()) return false;
  const std::vector<double> memory = std::move(remembered_);
  remembered_ = {};
  const std::vector<double> key = flow_key(flow, *first(), surface_.settings().free_mean);
  const auto count = static_cast<std::size_t>(memory[FLOW]), each = std::size_t(memory[FLOW + 1]);
  const auto shared = memory.begin() + HEAD;
  const double *const rows = memory.data() + HEAD + std::size_t(memory[FLOW + 2]);
  const auto tag = [&](std::size_t row) { return rows[row * (1 + each)]; };

  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return tag(a) < tag(b); });
  std::vector<double> built, of_markers;
  bool found = std::equal(key.begin(), key.end(), memory.begin());
  for (std::size_t n = 0; found && n < tags_.size(); ++n) {
    const auto mine = static_cast<double>(tags_[n]);
    const auto at = std::lower_bound(order.begin(), order.end(), mine,
                                     [&](std::size_t a, double wanted) { return tag(a) < wanted; });
    found = at != order.end() && tag(*at) == mine;
    if (!found) break;
    const double *const own = rows + *at * (1 + each) + 1;
    built.insert(built.end(), own, own + 3);
    of_markers.insert(of_markers.end(), own, own + each);
  }
  int differs[2] = {!found, built != position_};
  MPI_Allreduce(MPI_IN_PLACE, differs, 2, MPI_INT, MPI_MAX, world);
  bigint here = static_cast<bigint>(tags_.size()), all;
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (differs[0] || all != static_cast<bigint>(count)) return false;

  surface_.set_markers(flow, first()->settings().kernel, static_cast<int>(tags_.size()),
                       built.data(), body_.data());
  if (differs[1]) surface_.move(position_.data());
  surface_.remember({shared, shared + std::ptrdiff_t(memory[FLOW + 2])}, of_markers);
  surface_is_set_ = true;
  give_forces();
  return true;
}
