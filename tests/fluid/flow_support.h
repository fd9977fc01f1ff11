#pragma once

#include "fluid/flow.h"
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
      const bool on_plate = flow.grid().walls && c == 2 && k == 0;
      return on_plate ? 0 : amplitude * noise(4 * seed + c, i, j, k);
    });
}

/// A velocity without divergence: the steady flow of a noisy force density.
inline void set_noise_velocity(Flow &flow, int seed, double amplitude)
{
  Flow steady(flow.grid(), flow.decomposition(), 1, Regime{1});
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
inline void step_to(Flow &flow, double dt, const Drive &end)
{
  const Drive start = flow.drive;
  flow.drive = end;
  const auto middle = [](const Vec3 &a, const Vec3 &b) {
    return Vec3{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  };
  flow.drive.walls = {middle(start.walls.lower, end.walls.lower),
                      middle(start.walls.upper, end.walls.upper)};
  flow.drive.body = middle(start.body, end.body);
  flow.drive.mean = middle(start.mean, end.mean);
  flow.start_step(dt);
  flow.share_velocity();
  flow.drive = end;
  flow.finish_step();
}

inline void step(Flow &flow, double dt)
{
  step_to(flow, dt, flow.drive);
}

}    // namespace test
