#include "fluid/advection.h"

#include <cmath>

namespace fluid {

namespace {

/// Fluxes of momentum component c through the faces around its point p. `along[d]` is the step to
/// the next cell in direction d and `quarter[d]` is 1 / (4 h_d): two means of two velocities each.
struct Fluxes {
  std::array<const double *, 3> u;
  std::array<std::ptrdiff_t, 3> along;
  Real3 quarter;

  template <int c> double divergence(std::ptrdiff_t p) const
  {
    return through<c, 0>(p) + through<c, 1>(p) + through<c, 2>(p);
  }

 private:
  template <int c, int d> double through(std::ptrdiff_t p) const
  {
    const double *const carried = u[c], *const carrying = u[d];
    const std::ptrdiff_t next = along[d], back = along[c];
    if constexpr (c == d) {
      const double low = carried[p - next] + carried[p], high = carried[p] + carried[p + next];
      return quarter[d] * (high * high - low * low);
    }
    const double low = (carrying[p - back] + carrying[p]) * (carried[p - next] + carried[p]);
    const double high =
        (carrying[p + next - back] + carrying[p + next]) * (carried[p] + carried[p + next]);
    return quarter[d] * (high - low);
  }
};

template <int c>
void add_component(const Box &brick, const Box &stored, const Fluxes &fluxes, double factor,
                   const View<double> &result)
{
  const int n = brick.extent(0);
  for_each_row(brick, [&](int j, int k) {
    const std::ptrdiff_t first = stored.offset(brick.lo[0], j, k);
    double *const row = &result(brick.lo[0], j, k);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) row[i] += factor * fluxes.divergence<c>(first + i);
  });
}

}    // namespace

void add_advection(const Grid &grid, const Box &brick, const VectorField &velocity, double factor,
                   const VectorField &result)
{
  const Box &box = velocity.box();
  const std::ptrdiff_t row = box.extent(0);
  Fluxes fluxes{
      {velocity[0].data, velocity[1].data, velocity[2].data}, {1, row, row * box.extent(1)}, {}};
  for (int d = 0; d < 3; ++d) fluxes.quarter[d] = 0.25 / grid.spacing[d];
  add_component<0>(brick, box, fluxes, factor, result[0]);
  add_component<1>(brick, box, fluxes, factor, result[1]);
  add_component<2>(brick, box, fluxes, factor, result[2]);
}

FastestCell fastest_cell(const Grid &grid, const Box &brick, const VectorField &velocity)
{
  const auto u = velocity.views();
  const Real3 inverse{1 / grid.spacing[0], 1 / grid.spacing[1], 1 / grid.spacing[2]};
  const int first = brick.lo[0], n = brick.extent(0);
  FastestCell fastest;
  for_each_row(brick, [&](int j, int k) {
    const double *const x = &u[0](first, j, k), *const y = &u[1](first, j, k),
                        *const z = &u[2](first, j, k);
    const auto rate = [&](int i) {
      return inverse[0] * std::abs(x[i]) + inverse[1] * std::abs(y[i]) +
             inverse[2] * std::abs(z[i]);
    };
    bool faster = false;
    for (int i = 0; i < n; ++i) faster |= !(rate(i) <= fastest.rate);
    if (!faster) return;
    for (int i = 0; i < n && !std::isnan(fastest.rate); ++i)
      if (!(rate(i) <= fastest.rate)) fastest = {rate(i), {first + i, j, k}};
  });
  return fastest;
}

}    // namespace fluid
