#include "patch_mobility.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <numeric>

namespace fluid {

namespace {

constexpr double pi = 3.14159265358979323846;

// Added to the mobility of each marker with itself, relative to it. Markers closer than a cell make patches nearly
// singular; what they leave undetermined needs no force.
constexpr double regularisation = 0.02;

/// Mobility of two Gaussian blobs of standard deviation sigma / sqrt(2) at the distance r:
///   f I + g r r / r^2, from the Stokeslet (I lap - grad grad) H / (8 pi viscosity),
/// where H is the distance averaged over both blobs.
struct BlobPair {
  double f, g;

  BlobPair(double r, double sigma, double viscosity)
  {
    const double factor = 1 / (8 * pi * viscosity), s = r / sigma;
    const double peak = std::sqrt(2 / pi) / sigma;
    if (s < 1e-3) {    // the error is of order s^2
      f = factor * 4.0 / 3.0 * peak;
      g = 0;
      return;
    }
    const double bell = peak * std::exp(-0.5 * s * s), error = std::erf(s / std::sqrt(2.0)) / r;
    const double first = error * (1 - 1 / (s * s)) + bell / (s * s);    // H' / r
    const double second = 2 * (error - first);                          // H''
    f = factor * (second + first);
    g = factor * (first - second);
  }
};

}    // namespace

double marker_radius(KernelKind kernel)
{
  return kernel == KernelKind::peskin4 ? 1.25 : 0.91;
}

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
    divide(first, last, position);
    first = last;
  }

  const double radius = marker_radius(kernel) * std::cbrt(grid.cell_volume());
  const double sigma = std::sqrt(2 / pi) * radius;    // the same mobility of one blob
  const double self = 1 / (6 * pi * viscosity * radius);
  int largest = 0;
  for (Patch &patch : patches_) {
    largest = std::max(largest, patch.count);
    Eigen::MatrixXd mobility(3 * patch.count, 3 * patch.count);
    for (int n = 0; n < patch.count; ++n)
      for (int m = 0; m <= n; ++m) {
        const Eigen::Map<const Eigen::Vector3d> a(position + 3 * order_[patch.first + n]),
            b(position + 3 * order_[patch.first + m]);
        const Eigen::Vector3d apart = a - b;
        const double r = apart.norm();
        const BlobPair pair(r, sigma, viscosity);
        Eigen::Matrix3d block = pair.f * Eigen::Matrix3d::Identity();
        if (r > 0) block += pair.g / (r * r) * apart * apart.transpose();
        if (n == m) block.diagonal().array() += regularisation * self;
        mobility.block<3, 3>(3 * n, 3 * m) = block;
        mobility.block<3, 3>(3 * m, 3 * n) = block;
      }
    patch.inverse =
        mobility.llt().solve(Eigen::MatrixXd::Identity(mobility.rows(), mobility.cols()));
    patch.inverse = (0.5 * (patch.inverse + patch.inverse.transpose())).eval();
  }
  gathered_.resize(3 * largest);
  solved_.resize(3 * largest);
}

/// Halves the longest side until a patch is small enough.
void PatchMobility::divide(int first, int last, const double *position)
{
  if (last - first <= largest_patch) {
    if (last > first) patches_.push_back({first, last - first, {}});
    return;
  }
  Eigen::Array3d lo = Eigen::Array3d::Constant(HUGE_VAL), hi = -lo;
  for (int n = first; n < last; ++n) {
    const Eigen::Map<const Eigen::Array3d> x(position + 3 * order_[n]);
    lo = lo.min(x);
    hi = hi.max(x);
  }
  int side;
  (hi - lo).maxCoeff(&side);
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int a, int b) {
                     const double x = position[3 * a + side], y = position[3 * b + side];
                     return x < y || (x == y && a < b);
                   });
  divide(first, middle, position);
  divide(middle, last, position);
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
