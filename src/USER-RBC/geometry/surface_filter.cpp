#include "geometry/surface_filter.h"

#include <algorithm>
#include <cmath>

namespace rbc {

// s at q = k, where exp(-s) (1 + s) is a half

static constexpr double HALF = 1.678;

SurfaceFilter::SurfaceFilter(const SurfaceTemplate &surface, double wavenumber) :
    laplacian_(surface),
    degree_(std::max(
        1, static_cast<int>(std::lround(HALF * laplacian_.largest() / (wavenumber * wavenumber))))),
    linear_(surface.vertex_count()), area_(surface.vertex_area)
{
  find_linear_modes(surface);
}

void SurfaceFilter::find_linear_modes(const SurfaceTemplate &surface)
{
  for (int v = 0; v < vertex_count(); ++v) {
    const Vec3 &x = surface.vertices[v];
    linear_[v] = {1, x[0], x[1], x[2]};
  }
  const auto product = [this](int a, int b) {
    double sum = 0;
    for (int v = 0; v < vertex_count(); ++v) sum += area_[v] * linear_[v][a] * linear_[v][b];
    return sum;
  };
  for (int mode = 0; mode < modes; ++mode) {
    for (int repeat = 0; repeat < 2; ++repeat)    // once leaves round-off behind
      for (int before = 0; before < mode; ++before) {
        const double part = product(before, mode);
        for (Mode &linear : linear_) linear[mode] -= part * linear[before];
      }
    const double length = std::sqrt(product(mode, mode));
    for (Mode &linear : linear_) linear[mode] /= length;
  }
}

}    // namespace rbc
