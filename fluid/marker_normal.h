#pragma once

#include "fluid/marker_cloud.h"

#include <vector>

namespace fluid {

/// Of the surface that markers near one lie on, either way: of least variance about their mean.
/// Zero where they lie on no plane, at edges and between surfaces that are near each other.
Real3 marker_normal(const MarkerCloud &cloud, int marker, const std::vector<int> &near);

}    // namespace fluid
