#include "patch_mobility.h"

#include "lattice_mobility.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <numeric>

namespace fluid {

namespace {

// Added to the mobility of each marker with itself, relative to it. Markers closer than a cell make patches nearly
// singular; what they leave undetermined needs no force.
double regularisation = getenv("REG") ? atof(getenv("REG")) : 0.02;

}    // namespace

void PatchMobility::build(KernelKind kernel, const Grid &grid, double viscosity, int count,
                          const double *position, const int *body)
{
  order_.resize(count);
  patches_.clear();
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return body[a] < body[b]; });
  for (int first = 0; first < count;) {
    int last = first;
    while (last < count && body[order_[last]] == body[order_[first]]) ++last;
    divide(grid, first, last, position);
    first = last;
  }

  if (count == 0) return;
  const LatticeMobility lattice(kernel, grid, viscosity);
  int largest = 0;
  for (Patch &patch : patches_) {
    largest = std::max(largest, patch.count);
    Eigen::MatrixXd mobility(3 * patch.count, 3 * patch.count);
    for (int n = 0; n < patch.count; ++n)
      for (int m = 0; m <= n; ++m) {
        Eigen::Matrix<double, 3, 3, Eigen::RowMajor> block;
        lattice.pair(position + 3 * order_[patch.first + n], position + 3 * order_[patch.first + m],
                     block.data());
        if (n == m) block.diagonal().array() += regularisation * lattice.self();
        mobility.block<3, 3>(3 * n, 3 * m) = block;
        mobility.block<3, 3>(3 * m, 3 * n) = block.transpose();
      }
    patch.inverse =
        mobility.llt().solve(Eigen::MatrixXd::Identity(mobility.rows(), mobility.cols()));
    patch.inverse = (0.5 * (patch.inverse + patch.inverse.transpose())).eval();
  }
  gathered_.resize(3 * largest);
  solved_.resize(3 * largest);
}

/// Halves the longest side until a patch is small enough.
void PatchMobility::divide(const Grid &grid, int first, int last, const double *position)
{
  Eigen::Array3d lo = Eigen::Array3d::Constant(HUGE_VAL), hi = -lo;
  for (int n = first; n < last; ++n) {
    const Eigen::Map<const Eigen::Array3d> x(position + 3 * order_[n]);
    lo = lo.min(x);
    hi = hi.max(x);
  }
  const Eigen::Map<const Eigen::Array3d> spacing(grid.spacing.data());
  int side;
  const double longest = ((hi - lo) / spacing).maxCoeff(&side);
  if (last - first <= largest_patch && longest < LatticeMobility::reach) {
    patches_.push_back({first, last - first, {}});
    return;
  }
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int a, int b) {
                     const double x = position[3 * a + side], y = position[3 * b + side];
                     return x < y || (x == y && a < b);
                   });
  divide(grid, first, middle, position);
  divide(grid, middle, last, position);
}

void PatchMobility::apply(const double *velocity, double *force)
{
  for (const Patch &patch : patches_) {
    const int *const markers = order_.data() + patch.first;
    auto in = gathered_.head(3 * patch.count), out = solved_.head(3 * patch.count);
    for (int n = 0; n < patch.count; ++n)
      for (int d = 0; d < 3; ++d) in[3 * n + d] = velocity[3 * markers[n] + d];
    out.noalias() = patch.inverse * in;
    for (int n = 0; n < patch.count; ++n)
      for (int d = 0; d < 3; ++d) force[3 * markers[n] + d] = out[3 * n + d];
  }
}

std::size_t PatchMobility::bytes() const
{
  std::size_t sum = order_.capacity() * sizeof(int);
  for (const Patch &patch : patches_) sum += patch.inverse.size() * sizeof(double);
  return sum;
}

}    // namespace fluid
