#include "fluid/direct_forcing.h"

#include <cmath>

namespace fluid {

namespace {

template <typename Visit> void for_each_number(const MarkerSet &markers, Visit visit)
{
  for (int n = 0; n < markers.count; ++n)
    for (int d = 0; d < 3; ++d) visit(markers.index[n], 3 * std::size_t(markers.index[n]) + d);
}

template <std::size_t N> void sum_over_ranks(std::array<double, N> &values, const Flow &flow)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), N, MPI_DOUBLE, MPI_SUM, flow.decomposition().comm);
}

/// Largest component of a velocity, of the fluid or wanted of a marker.
double fastest(const Flow &flow, const MarkerSet &markers, const double *target)
{
  double speed = 0;
  for_each_number(markers,
                  [&](int, std::size_t i) { speed = std::max(speed, std::abs(target[i])); });
  const auto u = flow.velocity().views();
  for_each_cell(flow.brick(), [&](int i, int j, int k) {
    for (int c = 0; c < 3; ++c) speed = std::max(speed, std::abs(u[c](i, j, k)));
  });
  MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, flow.decomposition().comm);
  return speed;
}

}    // namespace

bool DirectForcing::solve_for_guess(Flow &flow, double dt, const Forcing &forcing,
                                    const Problem &problem, int &outside)
{
  const MarkerSet &markers = problem.markers;
  for_each_number(
      markers, [&](int, std::size_t i) { total_[i] = problem.applied[i] + problem.inertial[i]; });
  flow.clear_force();
  outside = flow.spread(markers, total_.data(), 1.0);
  std::array<double, 1> lost{outside >= 0 ? 1.0 : 0.0};
  sum_over_ranks(lost, flow);
  if (lost[0] > 0) return false;
  flow.accumulate_ghosts();
  if (flow.equations().inertia == Inertia::none)
    flow.solve(forcing);
  else
    flow.start_step(dt, forcing);
  flow.fill_ghosts();
  flow.interpolate(markers, problem.velocity);
  return true;
}

DirectForcing::Sums DirectForcing::sums(const Flow &flow, const Problem &problem) const
{
  std::array<double, 5> sums{};
  for_each_number(problem.markers, [&](int row, std::size_t i) {
    const double square = residual_[i] * residual_[i];
    const double force = problem.applied[i] + problem.inertial[i];
    sums[0] += square;
    sums[1] += square * problem.weight(row);
    sums[2] += square / problem.weight(row);
    sums[3] += force * force;
    sums[4] += 1;
  });
  sum_over_ranks(sums, flow);
  return {sums[0], sums[1], sums[2], sums[3], sums[4]};
}

void DirectForcing::conjugate_gradient_step(Flow &flow, const Problem &problem, double square)
{
  const MarkerSet &markers = problem.markers;
  const bool massive = problem.massive();
  for_each_number(markers, [&](int row, std::size_t i) {
    scaled_[i] = std::sqrt(problem.weight(row)) * direction_[i];
  });
  flow.apply_mobility(markers, scaled_.data(), response_.data());
  std::array<double, 1> curvature{};
  for_each_number(markers, [&](int, std::size_t i) {
    curvature[0] += scaled_[i] * response_[i];
    if (massive) curvature[0] += direction_[i] * direction_[i];
  });
  sum_over_ranks(curvature, flow);
  const double step = square / curvature[0];
  flow.add_mobility_flow(step);
  for_each_number(markers, [&](int row, std::size_t i) {
    problem.inertial[i] += step * scaled_[i];
    problem.velocity[i] += step * response_[i];
    residual_[i] -= step * std::sqrt(problem.weight(row)) * response_[i];
    if (massive) residual_[i] -= step * direction_[i];
  });
}

DirectForcing::Outcome DirectForcing::advance(Flow &flow, double dt, const Forcing &forcing,
                                              const Problem &problem)
{
  const MarkerSet &markers = problem.markers;
  const bool massive = problem.massive();
  for (auto *vector : {&total_, &residual_, &direction_, &scaled_, &response_})
    vector->resize(3 * std::size_t(problem.rows));

  Outcome outcome;
  if (!solve_for_guess(flow, dt, forcing, problem, outcome.outside)) return outcome;
  for_each_number(markers, [&](int row, std::size_t i) {
    const double root = std::sqrt(problem.weight(row));
    residual_[i] = root * (problem.target[i] - problem.velocity[i]);
    if (massive) residual_[i] -= problem.inertial[i] / root;
    direction_[i] = residual_[i];
  });

  const double speed = fastest(flow, markers, problem.target);
  Sums now = sums(flow, problem);
  const auto error = [&] {
    const double of_force = now.as_force == 0 ? 0 : std::sqrt(now.as_force / now.force);
    const double of_velocity =
        now.as_velocity == 0 ? 0 : std::sqrt(now.as_velocity / now.numbers) / speed;
    return massive ? std::min(of_force, of_velocity) : of_velocity;
  };
  while ((outcome.error = error()) > tolerance && outcome.solves < max_solves) {
    conjugate_gradient_step(flow, problem, now.residual);
    ++outcome.solves;
    const double before = now.residual;
    now = sums(flow, problem);
    const double turn = now.residual / before;
    for_each_number(
        markers, [&](int, std::size_t i) { direction_[i] = residual_[i] + turn * direction_[i]; });
  }
  return outcome;
}

}    // namespace fluid
