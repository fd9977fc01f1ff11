#pragma once

#include <Eigen/Core>

namespace rbc {

using Vec3 = Eigen::Vector3d;

}    // namespace rbc
