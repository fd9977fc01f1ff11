#include "fluid/marker_normal.h"

#include <Eigen/Eigenvalues>

namespace fluid {

// The largest ratio of the variance along the normal to the lesser one along the surface.
constexpr double flat = 0.2;

Real3 marker_normal(const MarkerCloud &cloud, int marker, const std::vector<int> &near)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (int other : near) {
    const Real3 apart = cloud.apart(marker, other);
    const Eigen::Vector3d r = Eigen::Map<const Eigen::Vector3d>(apart.data());
    mean += r;
    square += r * r.transpose();
  }
  const double count = static_cast<double>(near.size());
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(square / count - mean * mean.transpose() / (count * count));
  const auto &variances = axes.eigenvalues();
  if (!(variances[0] < flat * variances[1])) return {0, 0, 0};
  const Eigen::Vector3d normal = axes.eigenvectors().col(0);
  return {normal[0], normal[1], normal[2]};
}

}    // namespace fluid
