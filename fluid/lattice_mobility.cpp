#include "lattice_mobility.h"

#include "kernel.h"
#include "stokes_solver.h"

#include <cmath>

namespace fluid {

namespace {

constexpr int margin = 4;    ///< cells between the kernels of two markers and the cells of these
constexpr int period = 2 * (LatticeMobility::reach + margin);
constexpr int width = 7;     ///< of the difference of two points of kernels

/// Of the differences of grid points seen by two kernels in one direction: the first, and the weights of all.
struct Differences {
  int first;
  double weight[8];
};

template <typename Kernel>
Differences differences(double a, bool a_centre, double b, bool b_centre)
{
  double of_a[4], of_b[4];
  const int first_a = Kernel::weights(a_centre ? a - 0.5 : a, of_a);
  const int first_b = Kernel::weights(b_centre ? b - 0.5 : b, of_b);
  Differences result{first_a - first_b - 3, {}};
  for (int n = 0; n < 4; ++n)
    for (int m = 0; m < 4; ++m) result.weight[n - m + 3] += of_a[n] * of_b[m];
  return result;
}

}    // namespace

LatticeMobility::LatticeMobility(KernelKind kernel, const Grid &grid, double viscosity) :
    kernel_(kernel), grid_(grid)
{
  const Grid cube{{period, period, period}, {0, 0, 0}, grid.spacing, false};
  const Decomposition alone(MPI_COMM_SELF, cube.domain());
  StokesSolver solver(cube, alone, viscosity, 0, true);
  VectorField field(cube.domain());
  const int far = reach + margin + width;
  box_ = {{-far, -far, -far}, {far + 1, far + 1, far + 1}};
  // the part of an unbounded flow that a periodic one lacks (Hasimoto, J. Fluid Mech. 5 (1959) 317)
  constexpr double pi = 3.14159265358979323846;
  const double missing = 2.837297 / (6 * pi * viscosity * period * std::cbrt(grid.cell_volume()));
  for (int d = 0; d < 3; ++d) {
    field.clear();
    field[d](0, 0, 0) = 1 / grid.cell_volume();
    solver.velocity(field, {}, field);
    response_[d] = Components<double, 3>(box_);
    const auto wrap = [](int i) { return (i % period + period) % period; };
    for (int c = 0; c < 3; ++c)
      for_each_cell(box_, [&](int i, int j, int k) {
        response_[d][c](i, j, k) =
            field[c](wrap(i), wrap(j), wrap(k)) + (c == d ? missing : 0);
      });
  }
  for (int n = 0; n < 8; ++n) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = grid.origin[d] + grid.spacing[d] * 0.25 * (1 + (n >> d & 1));
    double mobility[9];
    pair(x.data(), x.data(), mobility);
    self_ += (mobility[0] + mobility[4] + mobility[8]) / 24;
  }
}

void LatticeMobility::pair(const double *a, const double *b, double *mobility) const
{
  Differences along[3][2][2];    // [direction][a in centres][b in centres]
  for (int d = 0; d < 3; ++d) {
    const double s = (a[d] - grid_.origin[d]) / grid_.spacing[d];
    const double t = (b[d] - grid_.origin[d]) / grid_.spacing[d];
    for (int p : {0, 1})
      for (int q : {0, 1})
        along[d][p][q] = kernel_ == KernelKind::peskin4 ? differences<Peskin4>(s, p, t, q)
                                                        : differences<Roma3>(s, p, t, q);
  }
  for (int c = 0; c < 3; ++c)
    for (int d = 0; d < 3; ++d) {
      const Differences &x = along[0][c != 0][d != 0], &y = along[1][c != 1][d != 1],
                        &z = along[2][c != 2][d != 2];
      const View<double> response = response_[d][c];
      double sum[8] = {};
      for (int k = 0; k < width; ++k)
        for (int j = 0; j < width; ++j) {
          const double *const row = &response(x.first, y.first + j, z.first + k);
          const double weight = y.weight[j] * z.weight[k];
          for (int i = 0; i < 8; ++i) sum[i] += weight * row[i];
        }
      double total = 0;
      for (int i = 0; i < width; ++i) total += x.weight[i] * sum[i];
      mobility[3 * c + d] = total;
    }
}

}    // namespace fluid
