// Error against run time of the flow solver on one core: manufactured flows between moving plates
// and triply periodic, over regimes, schemes, spacings and time steps. Prints CSV.

#include "manufactured.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numeric>

using namespace test;

namespace {

constexpr double start = 0.2, duration = 0.4;
constexpr double instant = pi / 2;    // of steady flow: the periodic one has no mean then

struct Setting {
  const char *name;
  Inertia inertia;
  double viscosity, density;    // density 0: the force of steady flow
  int frequencies;              // of the force in time
};

const std::vector<Setting> settings{{"none", Inertia::none, 0.5, 0, 5},
                                    {"unsteady", Inertia::unsteady, 0.5, 1, 5},
                                    {"convective", Inertia::convective, 0.05, 1, 10}};

template <typename Work> double seconds(const Work &work)
{
  const auto before = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

/// The force on the grid at any time, exact: a trigonometric polynomial in time, from samples of
/// its period.
class Force {
 public:
  Force(const Manufactured &exact, const ForcedFlow &flow, int frequencies) :
      now_(flow.force().box())
  {
    for (int m = 0; m <= 2 * frequencies; ++m) {
      times_.push_back(2 * pi * m / (2 * frequencies + 1));
      samples_.emplace_back(now_.box());
      set_vector(samples_.back(), flow.grid(), flow.brick(),
                 [&](int c, const Real3 &x) { return exact.force(c, x, times_[m]); });
    }
  }

  const VectorField &at(double t)
  {
    const int count = static_cast<int>(times_.size());
    std::vector<double> weight;
    for (double time : times_) {
      double sum = 0.5;
      for (int k = 1; k <= count / 2; ++k) sum += std::cos(k * (t - time));
      weight.push_back(2 * sum / count);
    }
    const std::size_t size = 3 * now_.box().size(), block = 1024;
    for (std::size_t first = 0; first < size; first += block) {
      double *const to = now_[0].data + first;
      const std::size_t n = std::min(block, size - first);
      std::fill_n(to, n, 0);
      for (int m = 0; m < count; ++m) {
        const double *const from = samples_[m][0].data + first;
        for (std::size_t i = 0; i < n; ++i) to[i] += weight[m] * from[i];
      }
    }
    return now_;
  }

 private:
  VectorField now_;
  std::vector<double> times_;
  std::vector<VectorField> samples_;
};

Real3 mean(const Real3 &a, const Real3 &b)
{
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// Relative rms errors of the velocity at the end and of the pressure in the middle of the last
/// step, to which it belongs.
struct Errors {
  double velocity, pressure;
};

Errors errors(const Manufactured &exact, ForcedFlow &flow, double end, double middle)
{
  const VectorField &u = flow.velocity();
  const ScalarField &p = flow.pressure();
  Error velocity, speed, pressure, push;
  for_each(flow.brick(), [&](int i, int j, int k) {
    for (int c = 0; c < 3; ++c) {
      const double value = exact.velocity(c, location(flow.grid(), c, i, j, k), end);
      velocity.add(u[c](i, j, k) - value);
      speed.add(value);
    }
    const double value = exact.pressure(location(flow.grid(), centre, i, j, k), middle);
    pressure.add(p[0](i, j, k) - value);
    push.add(value);
  });
  return {velocity.rms() / speed.rms(), pressure.rms() / push.rms()};
}

std::unique_ptr<ForcedFlow> make_flow(const Manufactured &exact, int n, Scheme scheme)
{
  const Grid grid = exact.grid({n, n, n});
  const bool hold_mean = exact.walls || exact.inertia == Inertia::none;
  const FlowEquations equations{exact.viscosity, exact.density, exact.inertia, scheme, hold_mean};
  auto flow = std::make_unique<ForcedFlow>(grid, alone(grid), 1, equations);
  flow->set_velocity([&](int c, int i, int j, int k) {
    return exact.velocity(c, location(grid, c, i, j, k), start);
  });
  return flow;
}

Forcing drive(const Manufactured &exact, double t)
{
  Forcing drive;
  drive.plates = {exact.plate(false, t), exact.plate(true, t)};
  return drive;
}

/// Cells of a grid of one cell across that the flow crosses in unit time, at most.
double crossing_rate(const Manufactured &exact)
{
  const Grid grid = exact.grid({16, 16, 16});
  double most = 0;
  for (double t = start; t < start + duration; t += duration / 16)
    for_each(grid.domain(), [&](int i, int j, int k) {
      double rate = 0;
      for (int c = 0; c < 3; ++c)
        rate += std::abs(exact.velocity(c, location(grid, centre, i, j, k), t)) / exact.size[c];
      most = std::max(most, rate);
    });
  return most;
}

struct Series {
  Scheme scheme;
  std::vector<double> step_seconds;    ///< the least of all repeats
  Errors errors{};

  double run_time() const { return std::accumulate(step_seconds.begin(), step_seconds.end(), 0.0); }
};

/// All schemes step by step beside each other, so that what else the machine does hits all.
void march(const Manufactured &exact, int n, Force &force, std::vector<Series> &all)
{
  const std::size_t steps = all[0].step_seconds.size();
  const double dt = duration / steps;
  std::vector<std::unique_ptr<ForcedFlow>> flows;
  for (const Series &series : all) {
    flows.push_back(make_flow(exact, n, series.scheme));
    flows.back()->forcing = drive(exact, start);
  }
  for (std::size_t step = 0; step < steps; ++step) {
    const VectorField &now = force.at(start + (step + 0.5) * dt);
    const Forcing end = drive(exact, start + (step + 1) * dt);
    for (std::size_t s = 0; s < all.size(); ++s) {
      ForcedFlow &flow = *flows[s];
      std::copy_n(now[0].data, 3 * now.box().size(), flow.force()[0].data);
      const PlateVelocities &from = flow.forcing.plates, &to = end.plates;
      flow.forcing.plates = {mean(from.lower, to.lower), mean(from.upper, to.upper)};
      const double spent = seconds([&] { flow.start_step(dt); });
      flow.forcing = end;
      double &least = all[s].step_seconds[step];
      least = std::min(least, spent + seconds([&] { flow.finish_step(); }));
    }
  }
  for (std::size_t s = 0; s < all.size(); ++s)
    all[s].errors = errors(exact, *flows[s], start + duration, start + duration - 0.5 * dt);
}

void print(const Setting &setting, const Manufactured &exact, int n, const Series &series,
           double crossings)
{
  const double steps = static_cast<double>(series.step_seconds.size());
  const double cells = 1.0 * n * n * n,
               h = *std::min_element(exact.size.begin(), exact.size.end()) / n;
  std::printf("%s,%s,%s,%d,", setting.name,
              series.scheme == Scheme::coupled ? "coupled" : "projection",
              exact.walls ? "plates" : "periodic", n * n * n);
  if (setting.inertia == Inertia::none)
    std::printf(",,,");
  else {
    const double dt = duration / steps;
    std::printf("%g,%.4g,%.4g,", dt, dt * exact.viscosity / exact.density / (h * h),
                dt * n * crossings);
  }
  std::printf("%g,%.4g,%.2f,%.3e,%.3e\n", steps, series.run_time(),
              1e9 * series.run_time() / (cells * steps), series.errors.velocity,
              series.errors.pressure);
  std::fflush(stdout);
}

/// The steady flow of one instant: a solve.
Series solve(const Manufactured &exact, int n)
{
  Series series{Scheme::coupled, {HUGE_VAL}};
  const auto flow = make_flow(exact, n, series.scheme);
  set_vector(flow->force(), flow->grid(), flow->brick(),
             [&](int c, const Real3 &x) { return exact.force(c, x, instant); });
  flow->forcing = drive(exact, instant);
  double &least = series.step_seconds[0];
  for (int repeat = 0; repeat < 20; ++repeat)
    least = std::min(least, seconds([&] { flow->solve(); }));
  series.errors = errors(exact, *flow, instant, instant);
  return series;
}

void study(const Setting &setting, bool walls, int n)
{
  Manufactured exact;
  exact.walls = walls;
  exact.viscosity = setting.viscosity;
  exact.density = setting.density;
  exact.inertia = setting.inertia;
  if (setting.inertia == Inertia::none) {
    print(setting, exact, n, solve(exact, n), 0);
    return;
  }

  const bool convective = setting.inertia == Inertia::convective;
  const double crossings = crossing_rate(exact);
  int steps = convective ? static_cast<int>(std::ceil(duration * n * crossings / 0.95)) : 4;
  std::vector<std::vector<Series>> runs;
  for (int refined = 0; refined < (convective ? 3 : 6); ++refined, steps *= 2) {
    runs.push_back({{Scheme::coupled, std::vector<double>(steps, HUGE_VAL)}});
    if (walls) runs.back().push_back({Scheme::projection, runs.back()[0].step_seconds});
  }
  Force force(exact, *make_flow(exact, n, Scheme::coupled), setting.frequencies);
  for (int repeat = 0; repeat < (n < 64 ? 5 : 2); ++repeat)
    for (std::vector<Series> &run : runs) march(exact, n, force, run);
  for (const std::vector<Series> &run : runs)
    for (const Series &series : run) print(setting, exact, n, series, crossings);
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  std::printf("equations,scheme,boundary,cells,dt,viscous_courant,courant,steps,run_time_s,"
              "ns_per_cell_step,velocity_error,pressure_error\n");
  for (const Setting &setting : settings)
    for (bool walls : {true, false})
      for (int n : {16, 32, 64}) study(setting, walls, n);
  MPI_Finalize();
}
