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

/* ---------------------------------------------------------------------- */

void SurfaceFilter::apply(std::vector<Row> &values, std::vector<Row> &scratch) const
{
  const Linear kept = take_linear(values);
  for (int number = 0; number < passes(); ++number) {
    const auto value = [&values](int w) -> Row { return values[w]; };
    for (int v = 0; v < vertex_count(); ++v) scratch[v] = pass(number, v, value);
    values.swap(scratch);
  }
  take_linear(values);
  for (int v = 0; v < vertex_count(); ++v)
    for (int mode = 0; mode < modes; ++mode) values[v] += linear_[v][mode] * kept[mode];
}

/// Takes from values their linear part, and returns it.
SurfaceFilter::Linear SurfaceFilter::take_linear(std::vector<Row> &values) const
{
  Linear parts;
  for (Row &part : parts) part.setZero();
  for (int v = 0; v < vertex_count(); ++v)
    for (int mode = 0; mode < modes; ++mode) parts[mode] += area_[v] * linear_[v][mode] * values[v];
  for (int v = 0; v < vertex_count(); ++v)
    for (int mode = 0; mode < modes; ++mode) values[v] -= linear_[v][mode] * parts[mode];
  return parts;
}

}    // namespace rbc
