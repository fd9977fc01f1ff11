#include "fluid/flow.h"
#include "fluid/history.h"

namespace fluid {

// The history is the velocity, with convection that before it, with projection the pressure modes.

namespace {

constexpr std::size_t head = 14;    // steps, dt, velocities of the plates now and before

Box all_modes(const Grid &grid)
{
  Box box = grid.domain();
  box.hi[0] = grid.cells[0] / 2 + 1;
  return box;
}

}    // namespace

std::size_t Flow::history_length() const
{
  if (equations_.inertia == Inertia::none) return 0;
  const std::size_t fields = equations_.inertia == Inertia::convective ? 2 : 1;
  return head + fields * 3 * grid_.size() +
         (solver_.kept_modes() ? 2 * all_modes(grid_).size() : 0);
}

std::vector<double> Flow::history()
{
  std::vector<double> all;
  if (equations_.inertia == Inertia::none) return all;
  const auto append = [&](const auto &whole) {
    const auto *const first = reinterpret_cast<const double *>(whole[0].data);
    all.insert(all.end(), first, first + whole.bytes() / sizeof(double));
  };
  const MPI_Comm comm = decomposition_.comm;
  if (decomposition_.rank == 0) {
    all.reserve(history_length());
    all.assign({static_cast<double>(steps_), dt_});
    for (const Real3 &plate :
         {plates_.lower, plates_.upper, previous_plates_.lower, previous_plates_.upper})
      all.insert(all.end(), plate.begin(), plate.end());
  }
  append(gather(comm, decomposition_.bricks, grid_.domain(), total_.velocity));
  if (equations_.inertia == Inertia::convective)
    append(gather(comm, decomposition_.bricks, grid_.domain(), previous_));
  if (const auto *kept = solver_.kept_modes())
    append(gather(comm, solver_.mode_bricks(), all_modes(grid_), *kept));
  return all;
}

void Flow::restore(const double *history)
{
  steps_ = static_cast<int>(history[0]);
  dt_ = history[1];
  const double *plate = history + 2;
  for (Real3 *to :
       {&plates_.lower, &plates_.upper, &previous_plates_.lower, &previous_plates_.upper}) {
    std::copy_n(plate, 3, to->begin());
    plate += 3;
  }
  const double *next = history + head;
  cut_out(brick(), grid_.domain(), next, total_.velocity);
  next += 3 * grid_.size();
  if (equations_.inertia == Inertia::convective) {
    cut_out(brick(), grid_.domain(), next, previous_);
    next += 3 * grid_.size();
    fill_ghosts_of(previous_, previous_plates_);
  }
  if (const auto *kept = solver_.kept_modes())
    cut_out(kept->box(), all_modes(grid_), reinterpret_cast<const Complex *>(next), *kept);
  shared_ = stepped_ = false;
  if (pressure_.bytes()) pressure_.clear();
}

void Flow::take_over(Flow &old)
{
  solved_forcing_ = old.solved_forcing_;
  plates_ = old.plates_;
  previous_plates_ = old.previous_plates_;
  if (has_force_) {
    total_.into_lower = old.total_.into_lower;
    total_.into_upper = old.total_.into_upper;
  }
  steps_ = old.steps_;
  solves_ = old.solves_;
  dt_ = old.dt_;
  if (equations_.inertia != Inertia::none) set_shift(old.shift_);
  stepped_ = old.stepped_;
  shared_ = false;
  const auto move_field = [&](const VectorField &from, const VectorField &to) {
    move(decomposition_.comm, old.decomposition_.bricks, from.views(), decomposition_.bricks,
         to.views());
  };
  move_field(old.total_.velocity, total_.velocity);
  if (old.has_force_ && has_force_) move_field(old.total_.force, total_.force);
  if (old.has_force_ && has_force_) take_layers(old);
  if (old.is_supplied_)
    move(decomposition_.comm, old.decomposition_.bricks, old.supply_.views(), decomposition_.bricks,
         supply().views());
  if (equations_.inertia != Inertia::none) move_field(old.previous_, previous_);
  if (equations_.inertia == Inertia::convective) move_field(old.rhs_, rhs_);
  if (equations_.inertia == Inertia::convective) fill_ghosts_of(previous_, previous_plates_);
  if (const auto *kept = solver_.kept_modes())
    move(decomposition_.comm, old.solver_.mode_bricks(), old.solver_.kept_modes()->views(),
         solver_.mode_bricks(), kept->views());
}

/// Source and viscosity of double layers.
void Flow::take_layers(const Flow &old)
{
  const auto move_field = [&](const ScalarField &from, ScalarField &to) {
    to = ScalarField(halo_.box());
    move(decomposition_.comm, old.decomposition_.bricks, from.views(), decomposition_.bricks,
         to.views());
  };
  total_.layered = old.total_.layered;
  if (total_.layered) move_field(old.total_.source, total_.source);
  knows_excess_ = old.knows_excess_;
  if (!knows_excess_) return;
  move_field(old.excess_, excess_);
  halo_.fill(excess_.views());
}

}    // namespace fluid
