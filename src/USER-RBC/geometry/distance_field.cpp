#include "geometry/distance_field.h"

#include "geometry/signed_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rbc {

namespace {

constexpr int spacings_per_radius = 32;
constexpr int block = 4;    // nodes in each direction, for which triangles are chosen together

/// Signed distance to a surface, by looking at all triangles that may be the nearest.
class ExactDistance {
 public:
  explicit ExactDistance(const SurfaceTemplate &surface)
  {
    for (const auto &corners : surface.triangles) {
      Triangle triangle;
      for (int c = 0; c < 3; ++c) triangle[c] = surface.vertices[corners[c]];
      triangles_.push_back(triangle);
      const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
      double radius = 0;
      for (const Vec3 &corner : triangle) radius = std::max(radius, (corner - middle).norm());
      middles_.push_back(middle);
      radii_.push_back(radius);
    }
    std::vector<SurfaceTemplate::Corners> neighbor(triangles_.size());
    for (const Hinge &hinge : surface.hinges)
      for (int c = 0; c < 3; ++c) {
        if (surface.triangles[hinge.left][c] == hinge.a) neighbor[hinge.left][c] = hinge.right;
        if (surface.triangles[hinge.right][c] == hinge.b) neighbor[hinge.right][c] = hinge.left;
      }
    normals_ = feature_normals(
        triangles_, surface.vertex_count(), [&](int t, int c) { return surface.triangles[t][c]; },
        [&](int t, int c) { return neighbor[t][c]; });
    all_.resize(triangles_.size());
    std::iota(all_.begin(), all_.end(), 0);
  }

  /// Chooses the triangles for points no further than `radius` from a centre; returns a bound for
  /// their distances.
  double choose(const Vec3 &centre, double radius)
  {
    const double distance = std::abs(among(all_, centre, std::numeric_limits<double>::infinity()));
    const double farthest = 1.001 * (distance + 2 * radius);
    chosen_.clear();
    for (const int t : all_)
      if ((centre - middles_[t]).norm() <= farthest + radii_[t]) chosen_.push_back(t);
    return 1.001 * (distance + radius);
  }

  /// Of a point for which triangles were chosen, known to be no further than `bound` away.
  double operator()(const Vec3 &p, double bound) const { return among(chosen_, p, bound); }

 private:
  std::vector<Triangle> triangles_;
  std::vector<FeatureNormals> normals_;
  std::vector<Vec3> middles_;
  std::vector<double> radii_;
  std::vector<int> all_, chosen_;    ///< in one order, which decides between those equally near

  double among(const std::vector<int> &chosen, const Vec3 &p, double bound) const
  {
    double least = std::numeric_limits<double>::infinity();
    int nearest = 0;
    std::array<double, 3> weights{};
    for (const int t : chosen) {
      const double too_far = std::min(bound, std::sqrt(least)) + radii_[t];
      if ((p - middles_[t]).squaredNorm() > too_far * too_far) continue;
      const auto w = closest_on_triangle(p, triangles_[t]);
      const double square = (point(t, w) - p).squaredNorm();
      if (square >= least) continue;
      least = square;
      nearest = t;
      weights = w;
    }
    const double side = (p - point(nearest, weights)).dot(normals_[nearest].at(weights));
    return std::copysign(std::sqrt(least), side);
  }

  Vec3 point(int t, const std::array<double, 3> &w) const
  {
    return w[0] * triangles_[t][0] + w[1] * triangles_[t][1] + w[2] * triangles_[t][2];
  }
};

}    // namespace

DistanceField::DistanceField(const SurfaceTemplate &surface, double reach) :
    lo_(surface.vertices[0]), hi_(lo_)
{
  for (const Vec3 &vertex : surface.vertices) {
    lo_ = lo_.cwiseMin(vertex);
    hi_ = hi_.cwiseMax(vertex);
  }
  spacing_ = (hi_ - lo_).maxCoeff() / 2 / spacings_per_radius;
  lo_.array() -= reach;
  for (int d = 0; d < 3; ++d) {
    nodes_[d] = 1 + static_cast<int>(std::ceil((hi_[d] + reach - lo_[d]) / spacing_));
    hi_[d] = lo_[d] + (nodes_[d] - 1) * spacing_;
  }

  ExactDistance exact(surface);
  const std::size_t row = nodes_[0], layer = row * nodes_[1];
  distance_.resize(layer * nodes_[2]);
  for (int k = 0; k < nodes_[2]; k += block)
    for (int j = 0; j < nodes_[1]; j += block)
      for (int i = 0; i < nodes_[0]; i += block) {
        const double half = 0.5 * (block - 1);
        const double far = exact.choose(lo_ + spacing_ * Vec3(i + half, j + half, k + half),
                                        std::sqrt(3.0) * half * spacing_);
        for (int n = k; n < std::min(k + block, nodes_[2]); ++n)
          for (int m = j; m < std::min(j + block, nodes_[1]); ++m) {
            double bound = far;
            for (int l = i; l < std::min(i + block, nodes_[0]); ++l) {
              const double distance = exact(lo_ + spacing_ * Vec3(l, m, n), bound);
              distance_[l + row * m + layer * n] = static_cast<float>(distance);
              // the distance changes no faster than the place
              bound = std::abs(distance) + 1.001 * spacing_;
            }
          }
      }
}

DistanceField::Sample DistanceField::at(const Vec3 &x) const
{
  const Vec3 nearest = x.cwiseMax(lo_).cwiseMin(hi_), beyond = x - nearest;
  Sample sample = interpolated(nearest);
  const double distance = beyond.norm();
  if (distance > 0) {
    sample.distance += distance;
    for (int d = 0; d < 3; ++d)
      if (beyond[d] != 0) sample.gradient[d] = 0;
    sample.gradient += beyond / distance;
  }
  return sample;
}

DistanceField::Sample DistanceField::interpolated(const Vec3 &x) const
{
  const Vec3 place = (x - lo_) / spacing_;
  int cell[3];
  double w[3];
  for (int d = 0; d < 3; ++d) {
    cell[d] = std::min(static_cast<int>(place[d]), nodes_[d] - 2);
    w[d] = place[d] - cell[d];
  }
  const std::size_t row = nodes_[0], layer = row * nodes_[1];
  const float *corner = &distance_[cell[0] + row * cell[1] + layer * cell[2]];
  double along_x[2][2], slope_x[2][2];
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j) {
      const float *pair = corner + j * row + k * layer;
      slope_x[k][j] = pair[1] - pair[0];
      along_x[k][j] = pair[0] + w[0] * slope_x[k][j];
    }
  const double slope_y[2] = {along_x[0][1] - along_x[0][0], along_x[1][1] - along_x[1][0]};
  const double along_y[2] = {along_x[0][0] + w[1] * slope_y[0], along_x[1][0] + w[1] * slope_y[1]};
  const double x_low = slope_x[0][0] + w[1] * (slope_x[0][1] - slope_x[0][0]),
               x_high = slope_x[1][0] + w[1] * (slope_x[1][1] - slope_x[1][0]);
  return {along_y[0] + w[2] * (along_y[1] - along_y[0]),
          Vec3(x_low + w[2] * (x_high - x_low), slope_y[0] + w[2] * (slope_y[1] - slope_y[0]),
               along_y[1] - along_y[0]) /
              spacing_};
}

}    // namespace rbc
