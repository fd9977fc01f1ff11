#include "fluid/sheet_velocity.h"

#include "fluid/plates.h"
#include "fluid/second_differences.h"

#include <algorithm>

namespace fluid {

namespace {

Box between_plates(Box box, const Grid &grid)
{
  if (!grid.plates || box.empty()) return box;
  box.lo[2] = std::max(box.lo[2], 0);
  box.hi[2] = std::min(box.hi[2], grid.cells[2]);
  return box;
}

}    // namespace

Box without_layers(Box box, const Grid &grid, int layers)
{
  if (box.empty()) return box;
  for (int d = 0; d < 3; ++d) {
    const bool plates = d == 2 && grid.plates;
    if (!plates || box.lo[d] >= 0) box.lo[d] += layers;
    if (!plates || box.hi[d] <= grid.cells[d]) box.hi[d] -= layers;
  }
  return box;
}

const VectorField &SheetVelocity::of(const VectorField &velocity, KernelKind kernel,
                                     const Grid &grid, const PlateVelocities &plates)
{
  const Box &box = velocity.box();
  const std::ptrdiff_t row = box.extent(0);
  if (!(result_.box() == box)) result_ = VectorField(box);
  for (auto &plane : curvature_) plane.resize(std::size_t(row) * box.extent(1));
  const auto [second, fourth] = sheet_correction(kernel);
  const double middle = second + 6 * fourth, next = fourth;
  const Box once = between_plates(without_layers(box, grid, 1), grid);
  const Box twice = between_plates(without_layers(box, grid, layers), grid);
  const int first = twice.lo[0], n = twice.extent(0);
  if (twice.empty()) return result_;
  for (int c = 0; c < 3; ++c) {
    const View<double> u = velocity[c], result = result_[c];
    for (int k = twice.lo[2] - 1; k <= twice.lo[2]; ++k) find_curvature(u, c, k, once, grid);
    for (int k = twice.lo[2]; k < twice.hi[2]; ++k) {
      find_curvature(u, c, k + 1, once, grid);
      for (int j = twice.lo[1]; j < twice.hi[1]; ++j) {
        const std::ptrdiff_t at = box.offset(first, j, box.lo[2]);
        const double *const bent = curvature(k) + at, *const below = curvature(k - 1) + at,
                            *const above = curvature(k + 1) + at, *const from = &u(first, j, k);
        double *const to = &result(first, j, k);
#pragma omp simd
        for (int i = 0; i < n; ++i) {
          const double around =
              bent[i - 1] + bent[i + 1] + bent[i - row] + bent[i + row] + below[i] + above[i];
          to[i] = from[i] - middle * bent[i] + next * around;
        }
      }
    }
  }
  if (grid.plates) reflect_velocity(grid, plates, result_);
  return result_;
}

/// Beyond plates the mirror image of the curvature, as of a velocity, without that of the plates.
void SheetVelocity::find_curvature(const View<double> &u, int component, int k, const Box &once,
                                   const Grid &grid)
{
  const PlateImage image = grid.plates ? plate_image(grid, component, k) : PlateImage{k, 1};
  const int first = once.lo[0], n = once.extent(0);
  for (int j = once.lo[1]; j < once.hi[1]; ++j) {
    double *const bent = curvature(k) + u.box.offset(first, j, u.box.lo[2]);
    if (image.factor == 0)
      std::fill_n(bent, n, 0.0);
    else
      second_differences(u, first, j, image.plane, n, bent);
    if (image.factor != 1)
      for (int i = 0; i < n; ++i) bent[i] *= image.factor;
  }
}

}    // namespace fluid
