// Poiseuille flow in a tube of markers: slip against solves.

#include "rigid_tube.h"

#include <cstdio>
#include <cstdlib>

using namespace test;

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  const double dx = argc > 1 ? std::atof(argv[1]) : 0.8, spacing = argc > 2 ? std::atof(argv[2]) : 1.2;
  const double R = argc > 6 ? std::atof(argv[6]) : 11.25, L = argc > 7 ? std::atof(argv[7]) : 32, W = argc > 8 ? std::atof(argv[8]) : 26, offset = argc > 3 ? std::atof(argv[3]) : 0.41;
  const double width = argc > 5 ? std::atof(argv[5]) : 0;
  const KernelKind kernel = argc > 4 && std::atoi(argv[4]) == 3 ? KernelKind::roma3 : KernelKind::peskin4;
  const int wide = fast_size(std::lround(W / dx)), lengthy = fast_size(std::lround(L / dx));
  const Grid grid{{lengthy, wide, wide}, {0, 0, 0}, {dx, dx, dx}, false};
  Points points = tube(grid, R + offset * dx, spacing * dx);
  const Decomposition decomposition = even(grid, {1, 1, ranks()});
  assign(points, grid, decomposition);
  const auto position = rows_here(points.position, points);
  const std::vector<int> body(points.index.size(), 0);
  for (double tol : {1e-3, 1e-5}) {
    Flow flow(grid, decomposition, 4, Regime{1.0});
    RigidSurface wall;
    wall.free_mean = true;
    wall.tolerance = tol;
    wall.max_solves = 60;
    wall.most_directions = 400;
    const double t0 = MPI_Wtime();
    wall.set_markers(flow, kernel, points.index.size(), position.data(), body.data());
    const double t1 = MPI_Wtime();
    flow.clear_force();
    Vec3 total{0, 0, 0};
    set(flow.force()[0], flow.brick(), [&](int i, int j, int k) {
      const double r = from_axis(grid, location(grid, 0, i, j, k)), inside = width < 0 ? 1 : width == 0 ? r < R : std::min(1.0, std::max(0.0, 0.5 + (R - r) / (width * dx)));
      total[0] += inside * grid.cell_volume();
      return inside;
    });
    wall.spread(flow, 0, total);
    flow.gather_force();
    flow.solve();
    const double t2 = MPI_Wtime();
    const auto outcome = wall.enforce(flow);
    const double t3 = MPI_Wtime();
    double flux = 0;
    for_each(flow.brick(), [&](int i, int j, int k) {
      if (i == 0 && from_axis(grid, location(grid, 0, i, j, k)) < R) flux += flow.velocity()[0](i, j, k) * dx * dx;
    });
    double true_slip = 0; {std::vector<double> u(position.size()); std::vector<int> ix(points.index.size()); for (size_t q=0;q<ix.size();++q) ix[q]=q; flow.interpolate(kernel, {(int)ix.size(), ix.data()}, position.data(), u.data()); for (double v : u) true_slip=std::max(true_slip,std::abs(v)); double sp=0; for_each(flow.brick(), [&](int i,int j,int k){sp=std::max(sp,std::abs(flow.velocity()[0](i,j,k)));}); true_slip=max(true_slip)/max(sp);} if (rank()==0) std::printf("true slip %.3g  ", true_slip);
    const double Q = sum(flux), exact = total[0] == 0 ? 1 : pi * R * R * R * R / 8;
    if (rank() == 0)
      std::printf("%g %d markers, tol %g: solves %d slip %.3g flow rate %+.3f %%, build %.3f s, solve %.3f s, enforce %.3f s each\n", spacing, points.count(), tol,
                  outcome.solves, outcome.slip, 100 * (Q / exact - 1), t1 - t0, t2-t1, (t3-t2)/std::max(1,outcome.solves-1));
  }
  MPI_Finalize();
}
