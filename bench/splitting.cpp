// Error of the projection scheme beside that of the coupled one: rolls and a Womersley flow between
// plates, at several viscous Courant numbers nu dt / h^2, in the middle of the last step, where
// markers move with the velocity. Prints CSV.

#include "fluid/flow.h"
#include "forced_flow.h"

#include <cmath>
#include <cstdio>
#include <map>

namespace {

using namespace fluid;
using test::ForcedFlow;

constexpr int n = 32;
constexpr double pi = 3.14159265358979323846;
constexpr double viscosity = 1, density = 1, h = 1.0 / n;
constexpr double slowest = 1000, reference = 0.5;    // viscous Courant numbers
constexpr double largest_step = slowest * h * h * density / viscosity;
constexpr double omega = 0.2 / largest_step, duration = 16 * largest_step;

const Grid grid{{4, n, n}, {0, 0, 0}, {h, h, h}, true};

Forcing drive(double t)
{
  Forcing drive;
  drive.plates.upper = {std::sin(omega * t), 0.2 * std::cos(omega * t), 0};
  drive.body = {10 * std::cos(omega * t), 0, 0};
  return drive;
}

void set_force(const ForcedFlow &flow, double t)
{
  const Box &brick = flow.brick();
  const double one = 50 * std::cos(omega * t), other = 50 * std::sin(omega * t + 1);
  for (int k = brick.lo[2]; k < brick.hi[2]; ++k)
    for (int j = brick.lo[1]; j < brick.hi[1]; ++j)
      for (int i = brick.lo[0]; i < brick.hi[0]; ++i) {
        flow.force()[1](i, j, k) = other * std::sin(2 * pi * h * j) * (k + 0.5) * h;
        flow.force()[2](i, j, k) = k > 0 ? one * std::cos(2 * pi * h * (j + 0.5)) : 0;
      }
}

template <typename T> T mean(const T &a, const T &b)
{
  T mean = a;
  for (std::size_t i = 0; i < a.size(); ++i) mean[i] = 0.5 * (a[i] + b[i]);
  return mean;
}

/// Values of this rank's brick one after the other: velocities, pressure, and the velocity along
/// the lower plate, extrapolated from the three cells next to it.
struct State {
  std::vector<double> velocity, pressure, plate;
};

State state(ForcedFlow &flow)
{
  State state;
  const Box &brick = flow.brick();
  const ScalarField &p = flow.pressure();
  const auto u = flow.velocity().views();
  for (int k = brick.lo[2]; k < brick.hi[2]; ++k)
    for (int j = brick.lo[1]; j < brick.hi[1]; ++j)
      for (int i = brick.lo[0]; i < brick.hi[0]; ++i) {
        for (int c = 0; c < 3; ++c) state.velocity.push_back(u[c](i, j, k));
        state.pressure.push_back(p[0](i, j, k));
        if (k > 0) continue;
        for (int c = 0; c < 2; ++c)
          state.plate.push_back((15 * u[c](i, j, 0) - 10 * u[c](i, j, 1) + 3 * u[c](i, j, 2)) / 8);
      }
  return state;
}

/// Root mean square of a, or of a - b, over all ranks.
double rms(const std::vector<double> &a, const std::vector<double> &b = {})
{
  double sums[2]{0, static_cast<double>(a.size())};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = a[i] - (b.empty() ? 0 : b[i]);
    sums[0] += difference * difference;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return std::sqrt(sums[0] / sums[1]);
}

/// Steps until the end; `visit(flow, step)` in the middle of each.
template <typename Visit>
void run(const Decomposition &decomposition, Scheme scheme, int steps, Visit visit)
{
  ForcedFlow flow(grid, decomposition, 1,
                  FlowEquations{viscosity, density, Inertia::unsteady, scheme});
  const double dt = duration / steps;
  for (int step = 0; step < steps; ++step) {
    const Forcing start = drive(step * dt), end = drive((step + 1) * dt);
    flow.forcing = start;
    flow.forcing.plates.upper = mean(start.plates.upper, end.plates.upper);
    flow.forcing.body = mean(start.body, end.body);
    set_force(flow, (step + 0.5) * dt);
    flow.start_step(dt);
    visit(flow, step);
    flow.forcing = end;
    flow.finish_step();
  }
}

State last(const Decomposition &decomposition, Scheme scheme, int steps)
{
  State last;
  run(decomposition, scheme, steps, [&](ForcedFlow &flow, int step) {
    if (step == steps - 1) last = state(flow);
  });
  return last;
}

void compare(const Decomposition &decomposition)
{
  const auto steps_of = [](double number) {
    return static_cast<int>(std::lround(duration / largest_step * slowest / number));
  };
  const std::vector<double> numbers{1, 4, 10, 40, 100, 400, 1000};

  // The middle of the last step of each is the end of one of the reference, between the middles of
  // two.
  std::map<int, std::vector<State>> around;
  const int total = steps_of(reference);
  for (double number : numbers) around[total - std::lround(number / (2 * reference))];
  run(decomposition, Scheme::coupled, total, [&](ForcedFlow &flow, int step) {
    for (auto &[end, states] : around)
      if (step == end - 1 || step == end) states.push_back(state(flow));
  });

  if (decomposition.rank == 0)
    std::printf("viscous_number,coupled_velocity,coupled_pressure,projection_velocity,"
                "projection_pressure,splitting_velocity,splitting_pressure,splitting_slip\n");
  for (double number : numbers) {
    const std::vector<State> &pair = around[total - std::lround(number / (2 * reference))];
    const auto exact = [&](std::vector<double> State::*field) {
      return mean(pair[0].*field, pair[1].*field);
    };
    const int steps = steps_of(number);
    const State coupled = last(decomposition, Scheme::coupled, steps),
                projected = last(decomposition, Scheme::projection, steps);
    const auto velocity = exact(&State::velocity), pressure = exact(&State::pressure);
    const double speed = rms(velocity), push = rms(pressure);
    const double row[]{rms(coupled.velocity, velocity) / speed,
                       rms(coupled.pressure, pressure) / push,
                       rms(projected.velocity, velocity) / speed,
                       rms(projected.pressure, pressure) / push,
                       rms(projected.velocity, coupled.velocity) / speed,
                       rms(projected.pressure, coupled.pressure) / push,
                       rms(projected.plate, coupled.plate) / speed};
    if (decomposition.rank != 0) continue;
    std::printf("%g", number);
    for (double value : row) std::printf(",%.2e", value);
    std::printf("\n");
    std::fflush(stdout);
  }
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  compare({MPI_COMM_WORLD, {{0, n * rank / ranks, 0}, {4, n * (rank + 1) / ranks, n}}});
  MPI_Finalize();
}
