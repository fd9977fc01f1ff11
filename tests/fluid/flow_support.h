#pragma once

#include "test_support.h"

namespace test {

template <int N> Components<double, N> copy(const Components<double, N> &field, const Box &brick)
{
  Components<double, N> copied(brick);
  for (int c = 0; c < N; ++c) set(copied[c], brick, field[c]);
  return copied;
}

/// The difference of two fields over all bricks.
template <int N>
Error difference(const Components<double, N> &one, const Components<double, N> &other,
                 const Box &brick)
{
  Error error;
  for (int c = 0; c < N; ++c)
    for_each(brick, [&](int i, int j, int k) { error.add(one[c](i, j, k) - other[c](i, j, k)); });
  return error.over_ranks();
}

/// A force density on all faces but those on a plate.
inline void set_noise_force(Flow &flow, int seed, double amplitude = 1)
{
  for (int c = 0; c < 3; ++c)
    set(flow.force()[c], flow.brick(), [&](int i, int j, int k) {
      const bool on_plate = flow.grid().plates && c == 2 && k == 0;
      return on_plate ? 0 : amplitude * noise(4 * seed + c, i, j, k);
    });
}

/// A velocity without divergence: the steady flow of a noisy force density.
inline void set_noise_velocity(Flow &flow, int seed, double amplitude)
{
  ForcedFlow steady(flow.grid(), flow.decomposition(), 1, FlowEquations{1});
  set_noise_force(steady, seed);
  steady.solve();
  const VectorField &u = steady.velocity();
  double largest = 0;
  for (int c = 0; c < 3; ++c)
    for_each(flow.brick(),
             [&](int i, int j, int k) { largest = std::max(largest, std::abs(u[c](i, j, k))); });
  const double factor = amplitude / max(largest);
  flow.set_velocity([&](int c, int i, int j, int k) { return factor * u[c](i, j, k); });
}

/// A step, with all that drives the flow in its middle the mean of its start and its end.
inline void step_to(ForcedFlow &flow, double dt, const Forcing &end)
{
  const Forcing start = flow.forcing;
  flow.forcing = end;
  const auto middle = [](const Real3 &a, const Real3 &b) {
    return Real3{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  };
  flow.forcing.plates = {middle(start.plates.lower, end.plates.lower),
                         middle(start.plates.upper, end.plates.upper)};
  flow.forcing.body = middle(start.body, end.body);
  flow.forcing.mean = middle(start.mean, end.mean);
  flow.start_step(dt);
  flow.fill_ghosts();
  flow.forcing = end;
  flow.finish_step();
}

inline void step(ForcedFlow &flow, double dt)
{
  step_to(flow, dt, flow.forcing);
}

}    // namespace test
