#include "fluid/flow.h"

#include <cassert>

namespace fluid {

namespace {

/// y += factor x over the brick and, where both are stored alike, its ghosts.
void add(const Box &brick, const VectorField &y, double factor, const VectorField &x)
{
  const Box &box = x.box() == y.box() ? x.box() : brick;
  const int first = box.lo[0], n = box.extent(0);
  for (int c = 0; c < 3; ++c)
    for_each_row(box, [&, from = x[c], to = y[c]](int j, int k) {
      const double *const x_row = &from(first, j, k);
      double *const y_row = &to(first, j, k);
      for (int i = 0; i < n; ++i) y_row[i] += factor * x_row[i];
    });
}

}    // namespace

Flow::Flow(const Grid &grid, const Decomposition &decomposition, int ghost_layers,
           const Regime &regime) :
    grid_(grid),
    decomposition_(decomposition), regime_(regime),
    halo_(grid, decomposition, std::max(ghost_layers, 1)), has_force_(ghost_layers > 0),
    velocity_(halo_.box()),
    solver_(grid, decomposition, regime.viscosity, 0.0, regime.hold_mean, regime.scheme)
{
  if (has_force_) force_ = VectorField(halo_.box());
  if (regime.inertia != Inertia::none) previous_ = VectorField(halo_.box());
  if (regime.inertia == Inertia::convective) rhs_ = VectorField(brick());
}

void Flow::clear_force()
{
  force_.clear();
  lower_direct_ = upper_direct_ = {0, 0, 0};
}

int Flow::spread(KernelKind kernel, const Markers &markers, const double *position,
                 const double *force, double factor, As as)
{
  return fluid::spread(kernel, grid_, markers, position, force, factor, force_, reach(as));
}

/// Where kernels find velocities: of sheets where these have neighbors on all sides, and beyond plates.
Box Flow::reach(As as) const
{
  Box box = halo_.box();
  if (as == As::points || box.empty()) return box;
  for (int d = 0; d < 3; ++d) {
    const bool plates = d == 2 && grid_.walls;
    if (!plates || box.lo[d] >= 0) ++box.lo[d];
    if (!plates || box.hi[d] <= grid_.cells[d]) --box.hi[d];
  }
  return box;
}

/// u - sharpening h_d^2 d2u/dx_d2, summed over the directions d.
const VectorField &Flow::sharpened(KernelKind kernel, const VectorField &velocity,
                                   const Walls &walls)
{
  if (!sharp_.bytes()) sharp_ = VectorField(halo_.box());
  const double share = sharpening(kernel);
  Box box = reach(As::sheets);
  if (grid_.walls && !box.empty()) {
    box.lo[2] = std::max(box.lo[2], 0);
    box.hi[2] = std::min(box.hi[2], grid_.cells[2]);
  }
  const std::ptrdiff_t row = velocity.box().extent(0), plane = row * velocity.box().extent(1);
  const int first = box.lo[0], n = box.extent(0);
  for (int c = 0; c < 3; ++c)
    for_each_row(box, [&, from = velocity[c], to = sharp_[c]](int j, int k) {
      const double *const u = &from(first, j, k);
      double *const result = &to(first, j, k);
      for (int i = 0; i < n; ++i)
        result[i] = (1 + 6 * share) * u[i] - share * (u[i - 1] + u[i + 1] + u[i - row] +
                                                      u[i + row] + u[i - plane] + u[i + plane]);
    });
  if (grid_.walls) reflect_velocity(grid_, walls, sharp_);
  return sharp_;
}

void Flow::gather_force()
{
  if (grid_.walls) fold_force(grid_, force_, lower_direct_, upper_direct_);
  halo_.add_back(force_.views());
}

void Flow::solve()
{
  if (!has_force()) velocity_.clear();
  solve_now(has_force() ? force_ : velocity_);
  walls_ = drive.walls;
  shared_ = false;
}

void Flow::solve_now(const VectorField &rhs)
{
  solved_drive_ = drive;
  solve_for(velocity_, rhs, drive);
}

void Flow::solve_for(const VectorField &velocity, const VectorField &rhs, const Drive &by)
{
  solver_.velocity(rhs, by, velocity);
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
      const double *const f = &force_[c](first, j, k);
      for (int i = 0; i < n; ++i) row[i] += f[i];
    });
}

void Flow::start_step(double dt)
{
  assert(regime_.inertia != Inertia::none);
  const double before = dt_;
  dt_ = dt;
  set_shift(2 * regime_.density / dt);

  if (regime_.inertia == Inertia::convective) {
    share_velocity();
    assemble(velocity_, rhs_);
    const double extrapolation = steps_ > 0 ? 0.5 * dt / before : 0;
    add_advection(grid_, brick(), velocity_, -regime_.density * (1 + extrapolation), rhs_);
    if (extrapolation > 0)
      add_advection(grid_, brick(), previous_, regime_.density * extrapolation, rhs_);
    std::swap(velocity_, previous_);
    solve_now(rhs_);
  } else {
    std::swap(velocity_, previous_);
    assemble(previous_, velocity_);
    solve_now(velocity_);
  }
  previous_walls_ = walls_;
  previous_shared_ = shared_;
  walls_ = drive.walls;
  shared_ = false;
  stepped_ = true;
}

void Flow::finish_step()
{
  walls_ = drive.walls;
  if (!damped()) {
    shared_ = shared_ && previous_shared_;
    const Box &box = shared_ ? velocity_.box() : brick();
    for (int c = 0; c < 3; ++c)
      for_each_row(box, [&, u = velocity_[c], start = previous_[c]](int j, int k) {
        double *const row = &u(box.lo[0], j, k);
        const double *const start_row = &start(box.lo[0], j, k);
        for (int i = 0; i < box.extent(0); ++i) row[i] = 2 * row[i] - start_row[i];
      });
    if (grid_.walls && shared_) reflect_velocity(grid_, walls_, velocity_);
  } else if (regime_.inertia == Inertia::convective) {
    for (int c = 0; c < 3; ++c)
      for_each_row(brick(), [&, u = velocity_[c], start = previous_[c], r = rhs_[c]](int j, int k) {
        for (int i = brick().lo[0]; i < brick().hi[0]; ++i)
          r(i, j, k) += shift_ * (u(i, j, k) - start(i, j, k));
      });
    solve_now(rhs_);
    shared_ = false;
  } else {
    std::swap(velocity_, previous_);
    assemble(previous_, velocity_);
    solve_now(velocity_);
    shared_ = false;
  }
  ++steps_;
}

void Flow::share_velocity()
{
  if (!shared_) fill_ghosts(velocity_, walls_);
  shared_ = true;
}

void Flow::fill_ghosts(const VectorField &velocity, const Walls &walls)
{
  halo_.fill(velocity.views());
  if (grid_.walls) reflect_velocity(grid_, walls, velocity);
}

Vec3 Flow::mean_force() const
{
  Vec3 mean{0, 0, 0};
  if (has_force_) {
    const auto f = force_.views();
    for_each_cell(brick(), [&](int i, int j, int k) {
      for (int c = 0; c < 3; ++c) mean[c] += f[c](i, j, k) / grid_.size();
    });
  }
  MPI_Allreduce(MPI_IN_PLACE, mean.data(), 3, MPI_DOUBLE, MPI_SUM, decomposition_.comm);
  return mean;
}

void Flow::share_force()
{
  halo_.fill(force_.views());
}

void Flow::interpolate(KernelKind kernel, const Markers &markers, const double *position,
                       double *velocity, As as)
{
  assert(shared_);
  const VectorField &field = as == As::sheets ? sharpened(kernel, velocity_, walls_) : velocity_;
  fluid::interpolate(kernel, grid_, markers, position, field, velocity);
}

void Flow::respond(KernelKind kernel, const Markers &markers, const double *position,
                   const double *force, double *velocity, As as)
{
  if (!response_.bytes()) {
    response_force_ = VectorField(halo_.box());
    response_ = VectorField(halo_.box());
  }
  response_force_.clear();
  const int outside =
      fluid::spread(kernel, grid_, markers, position, force, 1.0, response_force_, reach(as));
  assert(outside < 0);
  (void)outside;
  response_lower_ = response_upper_ = {0, 0, 0};
  if (grid_.walls) fold_force(grid_, response_force_, response_lower_, response_upper_);
  halo_.add_back(response_force_.views());
  solve_for(response_, response_force_, {});
  fill_ghosts(response_, {});
  const VectorField &field = as == As::sheets ? sharpened(kernel, response_, {}) : response_;
  fluid::interpolate(kernel, grid_, markers, position, field, velocity);
}

void Flow::add_response(double factor)
{
  add(brick(), force_, factor, response_force_);
  if (regime_.inertia == Inertia::convective) add(brick(), rhs_, factor, response_force_);
  add(brick(), velocity_, factor, response_);
  for (int c = 0; c < 3; ++c) {
    lower_direct_[c] += factor * response_lower_[c];
    upper_direct_[c] += factor * response_upper_[c];
  }
}

void Flow::add_mean(const Vec3 &velocity)
{
  assert(!grid_.walls && regime_.inertia == Inertia::none);
  for (int c = 0; c < 3; ++c) {
    double *const u = velocity_[c].data;
    const std::size_t n = velocity_.box().size();
    for (std::size_t i = 0; i < n; ++i) u[i] += velocity[c];
  }
}

const ScalarField &Flow::pressure()
{
  if (!pressure_.bytes()) pressure_ = ScalarField(halo_.box());
  const bool steady = regime_.inertia == Inertia::none;
  if (!steady && !stepped_) return pressure_;
  const bool kept = solver_.kept_modes() != nullptr;    // by a projection: nothing is left to solve
  const bool forces_only = steady && has_force_;
  if (!kept && !forces_only && !rhs_.bytes()) rhs_ = VectorField(brick());
  if (!kept && regime_.inertia == Inertia::unsteady) assemble(previous_, rhs_);
  solver_.pressure(forces_only ? force_ : rhs_, solved_drive_, pressure_);
  return pressure_;
}

Traffic Flow::traffic() const
{
  const Traffic transforms = solver_.traffic(), halo = halo_.traffic();
  return {transforms.messages + halo.messages, transforms.bytes + halo.bytes};
}

std::size_t Flow::bytes() const
{
  std::size_t sum = pressure_.bytes() + halo_.bytes() + solver_.bytes();
  for (const VectorField *field :
       {&force_, &velocity_, &previous_, &rhs_, &response_force_, &response_, &sharp_})
    sum += field->bytes();
  return sum;
}

}    // namespace fluid
