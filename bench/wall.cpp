// Slip against solves in a tube of atoms through which a given mean flow is led past a blob of
// force (a cell): conjugate gradients alone (there without the force), with the preconditioner, and
// with the directions of earlier evaluations (the force moved on by a twentieth of a cell a time).
// Writes a table.

#include "fluid/direct_forcing.h"
#include "rigid_tube.h"

#include <cstdio>

using namespace test;

namespace {

struct Tube {
  Grid grid;
  Decomposition decomposition;
  Points points;
  std::vector<double> position;
  std::vector<int> body;
  double radius;

  Tube(double radius, double spacing) : radius(radius)
  {
    const int wide = fast_size(static_cast<int>(std::ceil(2 * radius + 8)));
    grid = {{fast_size(static_cast<int>(2.8 * radius)), wide, wide}, {0, 0, 0}, {1, 1, 1}, false};
    decomposition = even(grid, {1, 1, ranks()});
    points = tube(grid, radius + surface_offset(KernelKind::peskin4), spacing);
    assign(points, grid, decomposition);
    position = rows_here(points.position, points);
    body.assign(points.index.size(), 0);
  }

  void start(ForcedFlow &flow, double at) const
  {
    flow.forcing.mean = {1, 0, 0};
    flow.clear_force();
    const Real3 x0{at, 0.5 * grid.cells[1] + 0.75 * radius, 0.5 * grid.cells[2]};
    for (int c = 0; c < 2; ++c)
      set(flow.force()[c], flow.brick(), [&](int i, int j, int k) {
        const Real3 x = location(grid, c, i, j, k);
        double square = 0;
        for (int d = 0; d < 3; ++d) square += std::pow((x[d] - x0[d]) / (0.1 * radius), 2);
        return (c == 0 ? -3 : 6) / radius * std::exp(-square);
      });
  }

  double slip(ForcedFlow &flow) const
  {
    std::vector<double> u(position.size());
    std::vector<int> index(points.index.size());
    for (std::size_t n = 0; n < index.size(); ++n) index[n] = static_cast<int>(n);
    flow.fill_ghosts();
    flow.interpolate({KernelKind::peskin4, MarkerKind::points, static_cast<int>(index.size()),
                      index.data(), position.data()},
                     u.data());
    double slip = 0, speed = 0;
    for (std::size_t n = 0; n < u.size(); n += 3)
      slip = std::max(slip, std::sqrt(u[n] * u[n] + u[n + 1] * u[n + 1] + u[n + 2] * u[n + 2]));
    for_each(flow.brick(), [&](int i, int j, int k) {
      speed = std::max(speed, std::abs(flow.velocity()[0](i, j, k)));
    });
    reduce(MPI_MAX, slip, speed);
    return slip / speed;
  }
};

void print(const char *name, const Tube &tube, const char *method, int solves, double slip)
{
  if (rank() != 0) return;
  std::printf("%s,%d,%s,%d,%.3g\n", name, tube.points.count(), method, solves, slip);
  std::fflush(stdout);
}

void plain(const char *name, const Tube &tube)
{
  std::vector<double> none(3 * tube.points.count()), force(none), velocity(none), x;
  for (const Real3 &at : tube.points.position) x.insert(x.end(), at.begin(), at.end());
  for (int solves : {2, 4, 8, 16, 32, 64, 128}) {
    ForcedFlow flow(tube.grid, tube.decomposition, 4, FlowEquations{});
    std::fill(force.begin(), force.end(), 0.0);
    flow.forcing.mean = {1, 0, 0};
    DirectForcing direct;
    direct.tolerance = 1e-12;
    direct.max_solves = solves;
    MarkerSet markers = tube.points.markers(KernelKind::peskin4);
    markers.position = x.data();
    direct.advance(flow, 0, flow.forcing,
                   {markers, none.data(), nullptr, none.data(), force.data(), velocity.data(),
                    tube.points.count()});
    print(name, tube, "plain", solves, tube.slip(flow));
  }
}

void rigid(const char *name, const Tube &tube, bool recycled)
{
  for (int solves = 1; solves <= (recycled ? 4 : 32); ++solves) {
    ForcedFlow flow(tube.grid, tube.decomposition, 4, FlowEquations{});
    RigidSurface surface;
    surface.set_markers(flow, KernelKind::peskin4, static_cast<int>(tube.body.size()),
                        tube.position.data(), tube.body.data());
    const auto evaluate = [&](double time) {
      tube.start(flow, 4 + 0.05 * time);
      surface.spread(flow, time, {0, 0, 0});
      flow.accumulate_ghosts();
      flow.solve();
      surface.enforce(flow);
    };
    RigidSurface::Settings settings;
    settings.tolerance = recycled ? 1e-3 : 1e-12;
    settings.max_solves = recycled ? 100 : solves;
    surface.set_settings(settings);
    for (int time = 0; time < (recycled ? 20 : 1); ++time) evaluate(time);
    if (recycled) {
      settings.tolerance = 1e-12;
      settings.max_solves = solves;
      surface.set_settings(settings);
      evaluate(20);
    }
    print(name, tube, recycled ? "recycled" : "preconditioned", solves, tube.slip(flow));
  }
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (rank() == 0) std::puts("case,markers,method,solves,slip");
  const std::tuple<const char *, double, double> cases[]{
      {"base", 14, 1.2}, {"closer", 14, 0.6}, {"finer", 28, 1.2}};
  for (const auto &[name, radius, spacing] : cases) {
    const Tube tube(radius, spacing);
    plain(name, tube);
    rigid(name, tube, false);
    rigid(name, tube, true);
  }
  MPI_Finalize();
}
