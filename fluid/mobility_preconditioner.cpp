#include "fluid/mobility_preconditioner.h"

#include "fluid/marker_cloud.h"
#include "fluid/marker_normal.h"
#include "fluid/normal_alias.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace fluid {

/// Gaussian blobs of standard deviation sigma / sqrt(2) in a fluid. With `second` and `fourth`,
/// lengths squared and to the fourth power, the velocity u that one causes counts as u - second lap
/// u + fourth lap lap u, see sheet_correction().
struct Blob {
  double sigma, viscosity;
  double second = 0, fourth = 0;
};

namespace {

constexpr double pi = 3.14159265358979323846;

// A marker depends on those before it within this many times the distance to the nearest of them.
constexpr double reach = 3;
// It depends on this number of markers at most: memory sets the time to apply the columns.
constexpr int most_rows = 40;
// The distance to the nearest marker before shrinks by this ratio from level to level.
constexpr double refinement = 0.75;

// The slip length that stands for the compliance of markers, in spacings of the grid.
constexpr double slip_length = 0.0003;
// Markers within discs of this radius, in spacings, are counted to find how much of the surface
// each of them stands for.
constexpr double disc = 2;

/// The part of normal_alias() that is taken off where so many markers are within the disc: 0.75
/// for 10, markers 1.2 spacings apart, and less for closer ones. Markers find forces that differ
/// from one to the next by which they see less of a pressure than in the mean, closer ones more of
/// these. Found by trial: what is left must not turn negative.
double part_taken_off(std::size_t within)
{
  return std::clamp(0.75 - 0.067 * (static_cast<double>(within) - 10), 0.0, 0.75);
}

// Added to the mobility of each marker with itself, relative to it.
constexpr double regularisation = 0.005;

// The part of a sheet's fourth-order correction that blobs have: the differences of the grid are
// smaller than derivatives where forces vary from marker to marker. Takes the fewest iterations.
constexpr double fourth_share = 0.25;

/// Mobility of two blobs at the distance r:
///   f I + g r r / r^2, from the Stokeslet (I lap - grad grad) K / (8 pi viscosity),
/// where K = H - second lap H + fourth lap lap H, and H is the distance averaged over both blobs.
struct BlobPair {
  double f, g;

  BlobPair(double r, const Blob &blob)
  {
    const double sigma = blob.sigma, s = r / sigma, square = sigma * sigma;
    const double factor = 1 / (8 * pi * blob.viscosity), peak = std::sqrt(2 / pi) / sigma;
    // lap H is twice the potential of a blob, and lap lap H is -2 bell / sigma^2
    const double bell = peak * std::exp(-0.5 * s * s), bent = 2 * blob.fourth / (square * square);
    double first, second;    // K' / r, K''
    if (s < 1e-3) {          // the error is of order s^2
      first = second = peak * (2.0 / 3 + blob.second * 2.0 / 3 / square + bent);
    } else {
      const double error = std::erf(s / std::sqrt(2.0)) / r;
      const double slope = (bell - error) / (r * r);    // of the potential, over r
      first = error * (1 - 1 / (s * s)) + bell / (s * s);
      second = 2 * (error - first);
      first += -2 * blob.second * slope + bent * bell;
      second += 2 * blob.second * (bell / square + 2 * slope) + bent * bell * (1 - s * s);
    }
    f = factor * (second + first);
    g = factor * (first - second);
  }
};

/// A single one of these blobs moves as a marker does.
Blob blob_like(const MarkerSet &markers, double h, double viscosity)
{
  Blob blob{std::sqrt(2 / pi) * marker_radius(markers.kernel) * h, viscosity};
  if (markers.kind == MarkerKind::sheets) {
    const SheetCorrection correction = sheet_correction(markers.kernel);
    blob.second = correction.second * h * h;
    blob.fourth = fourth_share * correction.fourth * h * h * h * h;
  }
  return blob;
}

/// Takes out of `waiting` the markers of the next level: those that are no nearer than the spacing
/// to each other and to the markers of earlier levels.
std::vector<int> take_level(const MarkerCloud &cloud, double spacing,
                            const std::vector<int> &before, std::vector<int> &waiting)
{
  MarkerBins sparse(cloud, spacing);
  for (int marker : before) sparse.add(marker);
  std::vector<int> level;
  auto left = waiting.begin();
  for (int marker : waiting) {
    const bool free = sparse.near(marker, [&](int other) {
      return cloud.body[other] != cloud.body[marker] ||
             cloud.distance2(marker, other) >= spacing * spacing;
    });
    if (free) {
      sparse.add(marker);
      level.push_back(marker);
    } else
      *left++ = marker;
  }
  waiting.erase(left, waiting.end());
  return level;
}

/// The marker itself, then the nearest of those of its body before it, within a distance.
std::vector<int> nearest_earlier(const MarkerCloud &cloud, const MarkerBins &earlier, int marker,
                                 double distance)
{
  std::vector<std::pair<double, int>> found;
  earlier.near(marker, [&](int other) {
    const double r2 = cloud.distance2(marker, other);
    if (cloud.body[other] == cloud.body[marker] && r2 <= distance * distance)
      found.emplace_back(r2, other);
    return true;
  });
  const std::size_t keep = std::min<std::size_t>(found.size(), most_rows);
  std::partial_sort(found.begin(), found.begin() + keep, found.end());
  std::vector<int> column{marker};
  for (std::size_t n = 0; n < keep; ++n) column.push_back(found[n].second);
  return column;
}

}    // namespace

double marker_radius(KernelKind kernel)
{
  return kernel == KernelKind::peskin4 ? 1.25 : 0.91;
}

void MobilityPreconditioner::build(const Flow &flow, const MarkerSet &markers, const int *body)
{
  const MarkerCloud cloud = gather(flow, markers.count, markers.position, body);
  const double h = std::cbrt(flow.grid().cell_volume());
  const double viscosity = flow.equations().viscosity;
  const auto compliances = set_compliance(cloud, markers, h, viscosity);
  set_columns(cloud, choose_rows(cloud, h), compliances, blob_like(markers, h, viscosity));
}

MarkerCloud MobilityPreconditioner::gather(const Flow &flow, int count, const double *position,
                                           const int *body)
{
  comm_ = flow.decomposition().comm;
  const int ranks = flow.decomposition().ranks(), me = flow.decomposition().rank;
  const Grid &grid = flow.grid();
  count_ = count;
  numbers_.resize(ranks);
  offsets_.resize(ranks);
  std::vector<int> counts(ranks), firsts(ranks);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  for (int r = 0; r < ranks; ++r) {
    numbers_[r] = 3 * counts[r];
    firsts[r] = r > 0 ? firsts[r - 1] + counts[r - 1] : 0;
    offsets_[r] = 3 * firsts[r];
  }
  first_ = firsts[me];
  const int all = firsts[ranks - 1] + counts[ranks - 1];
  all_.resize(3 * std::size_t(all));
  sums_.resize(all_.size());

  MarkerCloud cloud;
  cloud.position.resize(all);
  cloud.body.resize(all);
  cloud.origin = grid.origin;
  for (int d = 0; d < 3; ++d) {
    cloud.period[d] = grid.cells[d] * grid.spacing[d];
    cloud.periodic[d] = d < 2 || !grid.plates;
  }
  MPI_Allgatherv(position, 3 * count, MPI_DOUBLE, cloud.position.data(), numbers_.data(),
                 offsets_.data(), MPI_DOUBLE, comm_);
  MPI_Allgatherv(body, count, MPI_INT, cloud.body.data(), counts.data(), firsts.data(), MPI_INT,
                 comm_);
  return cloud;
}

/// The markers that each of this rank's depends on, itself first.
std::vector<std::vector<int>> MobilityPreconditioner::choose_rows(const MarkerCloud &cloud,
                                                                  double h) const
{
  // The order does not depend on which rank owns which markers.
  std::vector<int> waiting(cloud.count());
  std::iota(waiting.begin(), waiting.end(), 0);
  std::sort(waiting.begin(), waiting.end(), [&](int a, int b) {
    return std::tie(cloud.body[a], cloud.position[a]) < std::tie(cloud.body[b], cloud.position[b]);
  });

  std::vector<std::vector<int>> columns(count_);
  std::vector<int> before;
  double spacing = 0.5 * *std::max_element(cloud.period.begin(), cloud.period.end());
  for (; !waiting.empty(); spacing *= refinement) {
    const bool last = spacing < 0.1 * h;
    const std::vector<int> level =
        last ? std::exchange(waiting, {}) : take_level(cloud, spacing, before, waiting);
    MarkerBins earlier(cloud, reach * spacing);
    for (int marker : before) earlier.add(marker);
    for (int marker : level) {
      if (marker >= first_ && marker < first_ + count_)
        columns[marker - first_] = nearest_earlier(cloud, earlier, marker, reach * spacing);
      earlier.add(marker);
    }
    before.insert(before.end(), level.begin(), level.end());
  }
  return columns;
}

std::vector<double> MobilityPreconditioner::set_compliance(const MarkerCloud &cloud,
                                                           const MarkerSet &markers, double h,
                                                           double viscosity)
{
  const double disc_area = pi * disc * disc * h * h;
  const double slip = slip_length * h / viscosity;
  std::vector<double> areas(cloud.count()), compliances(cloud.count());
  MarkerBins close(cloud, disc * h);
  for (int marker = 0; marker < cloud.count(); ++marker) close.add(marker);
  const auto for_each_close = [&](int marker, auto visit) {
    close.near(marker, [&](int other) {
      if (cloud.body[other] == cloud.body[marker] &&
          cloud.distance2(marker, other) < disc * disc * h * h)
        visit(other);
      return true;
    });
  };
  std::vector<int> inside;
  alias_.resize(cloud.count());
  for (int marker = 0; marker < cloud.count(); ++marker) {
    inside.clear();
    for_each_close(marker, [&](int other) { inside.push_back(other); });
    areas[marker] = disc_area / static_cast<double>(inside.size());
    compliances[marker] = slip / areas[marker];
    const Real3 normal = marker_normal(cloud, marker, inside);
    const double seen =
        part_taken_off(inside.size()) * normal_alias(markers.kernel, markers.kind, normal);
    const double root = std::sqrt(std::max(seen, 0.0) * h / (viscosity * disc_area));
    alias_[marker] = {root * normal[0], root * normal[1], root * normal[2]};
  }
  other_compliance_ = slip / disc_area;
  own_compliance_.clear();
  disc_.clear();
  disc_starts_.assign(1, 0);
  for (int n = 0; n < count_; ++n) {
    double covered = 0;
    for_each_close(first_ + n, [&](int other) {
      disc_.push_back(other);
      covered += areas[other];
    });
    disc_starts_.push_back(static_cast<int>(disc_.size()));
    own_compliance_.push_back(other_compliance_ * covered / areas[first_ + n]);
  }
  return compliances;
}

void MobilityPreconditioner::set_columns(const MarkerCloud &cloud,
                                         const std::vector<std::vector<int>> &columns,
                                         const std::vector<double> &compliances, const Blob &blob)
{
  starts_.assign(1, 0);
  rows_.clear();
  blocks_.clear();
  std::size_t rows = 0;
  for (const auto &column : columns) rows += column.size();
  rows_.reserve(rows);
  blocks_.reserve(9 * rows);
  std::vector<Real3> apart;
  std::vector<double> compliance;
  for (int n = 0; n < count_; ++n) {
    apart.clear();
    compliance.clear();
    for (int row : columns[n]) {
      apart.push_back(cloud.apart(first_ + n, row));
      compliance.push_back(compliances[row]);
    }
    rows_.insert(rows_.end(), columns[n].begin(), columns[n].end());
    starts_.push_back(static_cast<int>(rows_.size()));
    add_column(apart, compliance, blob);
  }
}

/// With the mobility M of the markers of a column, E those of its first: M^-1 E C^-T, where C C^T =
/// E^T M^-1 E.
void MobilityPreconditioner::add_column(const std::vector<Real3> &apart,
                                        const std::vector<double> &compliance, const Blob &blob)
{
  const double extra = regularisation * BlobPair(0, blob).f;
  const int n = static_cast<int>(apart.size());
  Eigen::MatrixXd mobility(3 * n, 3 * n);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b <= a; ++b) {
      const Eigen::Vector3d r = Eigen::Map<const Eigen::Vector3d>(apart[a].data()) -
                                Eigen::Map<const Eigen::Vector3d>(apart[b].data());
      const double distance = r.norm();
      const BlobPair pair(distance, blob);
      Eigen::Matrix3d block = pair.f * Eigen::Matrix3d::Identity();
      if (distance > 0) block += pair.g / (distance * distance) * r * r.transpose();
      if (a == b) block.diagonal().array() += extra + compliance[a];
      mobility.block<3, 3>(3 * a, 3 * b) = block;
    }
  Eigen::MatrixXd column = Eigen::MatrixXd::Zero(3 * n, 3);
  column.topRows<3>().setIdentity();
  mobility.llt().solveInPlace(column);
  const Eigen::Matrix3d root = Eigen::Matrix3d(column.topRows<3>()).llt().matrixL();
  column = root.triangularView<Eigen::Lower>().solve(column.transpose()).transpose().eval();
  for (int a = 0; a < n; ++a)
    for (int e = 0; e < 3; ++e)
      for (int d = 0; d < 3; ++d) blocks_.push_back(static_cast<float>(column(3 * a + d, e)));
}

void MobilityPreconditioner::apply(const double *velocity, double *force)
{
  MPI_Allgatherv(velocity, 3 * count_, MPI_DOUBLE, all_.data(), numbers_.data(), offsets_.data(),
                 MPI_DOUBLE, comm_);
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (int n = 0; n < count_; ++n) {
    double t[3] = {0, 0, 0};
    for (int m = starts_[n]; m < starts_[n + 1]; ++m) {
      const double *const u = all_.data() + 3 * std::size_t(rows_[m]);
      const float *const b = &blocks_[9 * std::size_t(m)];
      for (int e = 0; e < 3; ++e)
        t[e] += b[3 * e] * u[0] + b[3 * e + 1] * u[1] + b[3 * e + 2] * u[2];
    }
    for (int m = starts_[n]; m < starts_[n + 1]; ++m) {
      double *const f = sums_.data() + 3 * std::size_t(rows_[m]);
      const float *const b = &blocks_[9 * std::size_t(m)];
      for (int d = 0; d < 3; ++d) f[d] += b[d] * t[0] + b[3 + d] * t[1] + b[6 + d] * t[2];
    }
  }
  if (numbers_.size() > 1)
    MPI_Allreduce(MPI_IN_PLACE, sums_.data(), static_cast<int>(sums_.size()), MPI_DOUBLE, MPI_SUM,
                  comm_);
  std::copy_n(sums_.data() + 3 * std::size_t(first_), 3 * count_, force);
}

void MobilityPreconditioner::apply_compliance(const double *force, double *velocity)
{
  MPI_Allgatherv(force, 3 * count_, MPI_DOUBLE, all_.data(), numbers_.data(), offsets_.data(),
                 MPI_DOUBLE, comm_);
  for (int n = 0; n < count_; ++n) {
    const Real3 &mine = alias_[first_ + n];
    Real3 others{0, 0, 0};
    double seen = 0;
    for (int m = disc_starts_[n]; m < disc_starts_[n + 1]; ++m) {
      const double *const f = all_.data() + 3 * std::size_t(disc_[m]);
      const Real3 &its = alias_[disc_[m]];
      for (int d = 0; d < 3; ++d) others[d] += f[d];
      const double along = its[0] * f[0] + its[1] * f[1] + its[2] * f[2];
      seen += mine[0] * its[0] + mine[1] * its[1] + mine[2] * its[2] < 0 ? -along : along;
    }
    for (int d = 0; d < 3; ++d)
      velocity[3 * n + d] =
          own_compliance_[n] * force[3 * n + d] - other_compliance_ * others[d] - mine[d] * seen;
  }
}

std::size_t MobilityPreconditioner::bytes() const
{
  return (starts_.capacity() + rows_.capacity() + disc_starts_.capacity() + disc_.capacity()) *
             sizeof(int) +
         blocks_.capacity() * sizeof(float) + alias_.capacity() * sizeof(Real3) +
         (all_.capacity() + sums_.capacity() + own_compliance_.capacity()) * sizeof(double);
}

}    // namespace fluid
