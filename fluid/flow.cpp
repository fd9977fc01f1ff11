#include "fluid/flow.h"

#include <cassert>

namespace fluid {

namespace {

/// y += factor x over a box.
template <int N>
void add(const Components<double, N> &y, double factor, const Components<double, N> &x,
         const Box &box)
{
  const int first = box.lo[0], n = box.extent(0);
  for (int c = 0; c < N; ++c)
    for_each_row(box, [&, from = x[c], to = y[c]](int j, int k) {
      const double *const x_row = &from(first, j, k);
      double *const y_row = &to(first, j, k);
      for (int i = 0; i < n; ++i) y_row[i] += factor * x_row[i];
    });
}

}    // namespace

Flow::Flow(const Grid &grid, const Decomposition &decomposition, int ghost_layers,
           const FlowEquations &equations, bool sheets) :
    grid_(grid),
    decomposition_(decomposition), equations_(equations),
    halo_(grid, decomposition, std::max(ghost_layers, 1)), has_force_(ghost_layers > 0),
    solver_(grid, decomposition, equations.viscosity, 0.0, equations.hold_mean, equations.scheme,
            sheets ? 3 * halo_.box().size() : 0)
{
  if (sheets) sheets_ = {halo_.box(), solver_.lent()};
  total_.velocity = VectorField(halo_.box());
  if (has_force_) total_.force = VectorField(halo_.box());
  if (equations.inertia != Inertia::none) previous_ = VectorField(halo_.box());
  if (equations.inertia == Inertia::convective) rhs_ = VectorField(brick());
}

void Flow::clear_force()
{
  total_.clear_force();
}

int Flow::spread(const MarkerSet &markers, const double *force, double factor)
{
  return spread(markers, force, factor, total_);
}

int Flow::spread(const MarkerSet &markers, const double *force, double factor, ForcedVelocity &flow)
{
  const bool layers = markers.kind == MarkerKind::layers;
  if (layers) {
    flow.corrected = true;
    flow.kernel = markers.kernel;
    if (!flow.to_correct.bytes()) flow.to_correct = VectorField(halo_.box());
  }
  return fluid::spread(grid_, markers, force, factor, layers ? flow.to_correct : flow.force,
                       reach(markers.kind));
}

int Flow::spread(const MarkerSet &markers, const DoubleLayer &layer)
{
  return spread(markers, layer, total_);
}

int Flow::spread(const MarkerSet &markers, const DoubleLayer &layer, ForcedVelocity &flow)
{
  assert(equations_.inertia == Inertia::none);
  flow.layered = true;
  if (!flow.source.bytes()) flow.source = ScalarField(halo_.box());
  return fluid::spread(grid_, markers, layer, equations_.viscosity, flow.force, flow.source,
                       halo_.box());
}

ScalarField &Flow::supply()
{
  assert(equations_.inertia == Inertia::none);
  if (!is_supplied_) supply_ = ScalarField(brick());
  is_supplied_ = true;
  return supply_;
}

void Flow::end_supply()
{
  is_supplied_ = false;
  supply_ = ScalarField();
}

/// The box inside which kernels must stay.
Box Flow::reach(MarkerKind kind) const
{
  const int layers = kind == MarkerKind::sheets ? SheetVelocity::layers : 0;
  return without_layers(halo_.box(), grid_, layers);
}

void Flow::accumulate_ghosts()
{
  accumulate_ghosts_of(total_);
  if (total_.layered && is_supplied_) add(total_.source, 1, supply_, brick());
}

void Flow::accumulate_ghosts_of(ForcedVelocity &flow)
{
  if (grid_.plates) fold_force(grid_, flow.force, flow.into_lower, flow.into_upper);
  halo_.accumulate(flow.force.views());
  if (flow.layered) {
    if (grid_.plates) fold_source(grid_, flow.source);
    halo_.accumulate(flow.source.views());
  }
  if (flow.corrected) add_corrected(flow);
}

/// Adds the forces of layers, corrected as the velocity of sheets is, which commutes with the
/// solve.
void Flow::add_corrected(ForcedVelocity &flow)
{
  if (grid_.plates) fold_force(grid_, flow.to_correct, flow.into_lower, flow.into_upper);
  halo_.accumulate(flow.to_correct.views());
  fill_ghosts_of(flow.to_correct, {});
  add(flow.force, 1, sheets_.of(flow.to_correct, flow.kernel, grid_, {}), brick());
  if (grid_.plates)
    balance_correction(grid_, brick(), flow.kernel, flow.to_correct, flow.into_lower,
                       flow.into_upper);
}

void Flow::solve(const Forcing &forcing)
{
  if (!has_force()) total_.velocity.clear();
  solve_now(has_force() ? total_.force : total_.velocity, forcing);
  plates_ = forcing.plates;
  shared_ = false;
}

void Flow::solve_now(const VectorField &rhs, const Forcing &forcing)
{
  solved_forcing_ = forcing;
  solve_for(total_.velocity, rhs, forcing, source());
}

void Flow::solve_for(const VectorField &velocity, const VectorField &rhs, const Forcing &forcing,
                     const ScalarField *source)
{
  solver_.velocity(rhs, forcing, velocity, source);
  ++solves_;
}

void Flow::set_shift(double shift)
{
  if (shift == shift_) return;
  shift_ = shift;
  solver_.set_shift(shift);
}

/// result = f + shift u: what the momentum equation holds besides its unknowns, without advection.
void Flow::assemble(const VectorField &velocity, const VectorField &result) const
{
  const int first = brick().lo[0], n = brick().extent(0);
  for (int c = 0; c < 3; ++c)
    for_each_row(brick(), [&, u = velocity[c], to = result[c]](int j, int k) {
      const double *const u_row = &u(first, j, k);
      double *const row = &to(first, j, k);
      for (int i = 0; i < n; ++i) row[i] = shift_ * u_row[i];
      if (!has_force()) return;
      const double *const f = &total_.force[c](first, j, k);
      for (int i = 0; i < n; ++i) row[i] += f[i];
    });
}

void Flow::start_step(double dt, const Forcing &forcing)
{
  assert(equations_.inertia != Inertia::none);
  const double before = dt_;
  dt_ = dt;
  set_shift(2 * equations_.density / dt);

  if (equations_.inertia == Inertia::convective) {
    fill_ghosts();
    assemble(total_.velocity, rhs_);
    const double extrapolation = steps_ > 0 ? 0.5 * dt / before : 0;
    add_advection(grid_, brick(), total_.velocity, -equations_.density * (1 + extrapolation), rhs_);
    if (extrapolation > 0)
      add_advection(grid_, brick(), previous_, equations_.density * extrapolation, rhs_);
    std::swap(total_.velocity, previous_);
    solve_now(rhs_, forcing);
  } else {
    std::swap(total_.velocity, previous_);
    assemble(previous_, total_.velocity);
    solve_now(total_.velocity, forcing);
  }
  previous_plates_ = plates_;
  previous_shared_ = shared_;
  plates_ = forcing.plates;
  shared_ = false;
  stepped_ = true;
}

void Flow::finish_step(const Forcing &forcing)
{
  plates_ = forcing.plates;
  if (!damped()) {
    shared_ = shared_ && previous_shared_;
    const Box &box = shared_ ? total_.velocity.box() : brick();
    for (int c = 0; c < 3; ++c)
      for_each_row(box, [&, u = total_.velocity[c], start = previous_[c]](int j, int k) {
        double *const row = &u(box.lo[0], j, k);
        const double *const start_row = &start(box.lo[0], j, k);
        for (int i = 0; i < box.extent(0); ++i) row[i] = 2 * row[i] - start_row[i];
      });
    if (grid_.plates && shared_) reflect_velocity(grid_, plates_, total_.velocity);
  } else if (equations_.inertia == Inertia::convective) {
    for (int c = 0; c < 3; ++c)
      for_each_row(brick(),
                   [&, u = total_.velocity[c], start = previous_[c], r = rhs_[c]](int j, int k) {
                     for (int i = brick().lo[0]; i < brick().hi[0]; ++i)
                       r(i, j, k) += shift_ * (u(i, j, k) - start(i, j, k));
                   });
    solve_now(rhs_, forcing);
    shared_ = false;
  } else {
    std::swap(total_.velocity, previous_);
    assemble(previous_, total_.velocity);
    solve_now(total_.velocity, forcing);
    shared_ = false;
  }
  ++steps_;
}

void Flow::fill_ghosts()
{
  if (!shared_) fill_ghosts_of(total_.velocity, plates_);
  shared_ = true;
}

void Flow::fill_ghosts_of(const VectorField &velocity, const PlateVelocities &plates)
{
  halo_.fill(velocity.views());
  if (grid_.plates) reflect_velocity(grid_, plates, velocity);
}

Real3 Flow::mean_force() const
{
  Real3 mean{0, 0, 0};
  if (has_force_) {
    const auto f = total_.force.views();
    for_each_cell(brick(), [&](int i, int j, int k) {
      for (int c = 0; c < 3; ++c) mean[c] += f[c](i, j, k) / grid_.size();
    });
  }
  MPI_Allreduce(MPI_IN_PLACE, mean.data(), 3, MPI_DOUBLE, MPI_SUM, decomposition_.comm);
  return mean;
}

void Flow::fill_force_ghosts()
{
  halo_.fill(total_.force.views());
}

/// The velocity field that kernels of such markers interpolate.
const VectorField &Flow::seen_by(const MarkerSet &markers, const VectorField &velocity,
                                 const PlateVelocities &plates)
{
  if (markers.kind != MarkerKind::sheets) return velocity;
  return sheets_.of(velocity, markers.kernel, grid_, plates);
}

void Flow::interpolate(const MarkerSet &markers, double *velocity)
{
  fill_ghosts();
  fluid::interpolate(grid_, markers, seen_by(markers, total_.velocity, plates_), velocity);
}

int Flow::apply_mobility(const MarkerSet &markers, const double *force, double *velocity,
                         const DoubleLayer *layer, const Real3 &mean, bool with_forces)
{
  if (!mobility_.velocity.bytes()) {
    if (!mobility_.force.bytes()) mobility_.force = VectorField(halo_.box());
    mobility_.velocity = VectorField(halo_.box());
  }
  mobility_.clear_force();
  int outside = with_forces ? spread(markers, force, 1.0, mobility_) : -1;
  if (layer) outside = std::max(outside, spread(markers, *layer, mobility_));
  accumulate_ghosts_of(mobility_);
  solve_for(mobility_.velocity, mobility_.force, {{}, {0, 0, 0}, mean},
            mobility_.layered ? &mobility_.source : nullptr);
  fill_ghosts_of(mobility_.velocity, {});
  if (outside < 0)
    fluid::interpolate(grid_, markers, seen_by(markers, mobility_.velocity, {}), velocity);
  return outside;
}

void Flow::add_mobility_flow(double factor)
{
  // ghosts, too, where both fields have them
  const Box &stored = total_.velocity.box();
  add(total_.force, factor, mobility_.force, stored);
  if (equations_.inertia == Inertia::convective) add(rhs_, factor, mobility_.force, brick());
  add(total_.velocity, factor, mobility_.velocity, stored);
  if (mobility_.layered) add(total_.source, factor, mobility_.source, stored);
  for (int c = 0; c < 3; ++c) {
    total_.into_lower[c] += factor * mobility_.into_lower[c];
    total_.into_upper[c] += factor * mobility_.into_upper[c];
  }
}

const VectorField &Flow::fluid_velocity()
{
  fill_ghosts();
  if (!total_.layered || !knows_excess_) return total_.velocity;
  if (!fluid_velocity_.bytes()) fluid_velocity_ = VectorField(halo_.box());
  for (int c = 0; c < 3; ++c) {
    Box box = halo_.box();
    if (!box.empty()) ++box.lo[c];
    for_each_cell(box, [&, w = total_.velocity[c], u = fluid_velocity_[c],
                        excess = excess_[0]](int i, int j, int k) {
      const double below = excess(i - (c == 0), j - (c == 1), k - (c == 2));
      u(i, j, k) = w(i, j, k) / (1 + 0.5 * (below + excess(i, j, k)));
    });
  }
  return fluid_velocity_;
}

/// The force of such surfaces is a gradient, and what they drive is no flow but its pressure.
int Flow::find_inside(const MarkerSet &markers, const double *step, double mean,
                      const ScalarField &inside)
{
  if (!mobility_.force.bytes()) mobility_.force = VectorField(halo_.box());
  mobility_.clear_force();
  const int outside = fluid::spread(grid_, markers, step, -1.0, mobility_.force, halo_.box());
  accumulate_ghosts_of(mobility_);
  solver_.pressure(mobility_.force, {}, inside);
  ++solves_;
  for_each_cell(brick(), [&, value = inside[0]](int i, int j, int k) { value(i, j, k) += mean; });
  return outside;
}

int Flow::find_excess(const MarkerSet &markers, const double *step, double mean,
                      const std::array<double, 2> &bounds)
{
  if (!excess_.bytes()) excess_ = ScalarField(halo_.box());
  const int outside = find_inside(markers, step, mean, excess_);
  for_each_cell(brick(), [&, excess = excess_[0]](int i, int j, int k) {
    excess(i, j, k) = std::clamp(excess(i, j, k), bounds[0], bounds[1]);
  });
  halo_.fill(excess_.views());
  knows_excess_ = true;
  return outside;
}

void Flow::add_mean(const Real3 &velocity)
{
  assert(!grid_.plates && equations_.inertia == Inertia::none);
  for (int c = 0; c < 3; ++c) {
    double *const u = total_.velocity[c].data;
    const std::size_t n = total_.velocity.box().size();
    for (std::size_t i = 0; i < n; ++i) u[i] += velocity[c];
  }
}

const ScalarField &Flow::pressure()
{
  if (!pressure_.bytes()) pressure_ = ScalarField(halo_.box());
  const bool steady = equations_.inertia == Inertia::none;
  if (!steady && !stepped_) return pressure_;
  const bool kept = solver_.kept_modes() != nullptr;    // by a projection: nothing is left to solve
  const bool forces_only = steady && has_force_;
  if (!kept && !forces_only && !rhs_.bytes()) rhs_ = VectorField(brick());
  if (!kept && equations_.inertia == Inertia::unsteady) assemble(previous_, rhs_);
  solver_.pressure(forces_only ? total_.force : rhs_, solved_forcing_, pressure_, supplied());
  return pressure_;
}

Traffic Flow::traffic() const
{
  const Traffic transforms = solver_.traffic(), halo = halo_.traffic();
  return {transforms.messages + halo.messages, transforms.bytes + halo.bytes};
}

std::size_t Flow::bytes() const
{
  std::size_t sum = pressure_.bytes() + halo_.bytes() + solver_.bytes() + sheets_.bytes() +
                    excess_.bytes() + supply_.bytes() + total_.source.bytes() +
                    mobility_.source.bytes();
  for (const ForcedVelocity *flow : {&total_, &mobility_})
    for (const VectorField *field : {&flow->force, &flow->velocity, &flow->to_correct})
      sum += field->bytes();
  for (const VectorField *field : {&previous_, &rhs_, &fluid_velocity_}) sum += field->bytes();
  return sum;
}

}    // namespace fluid
