#include "fluid/sheet_velocity.h"

#include "fluid/plates.h"

#include <algorithm>

namespace fluid {

namespace {

/// Calls `add(c, j, k, result, at, row, plane, n)` for each component c and each row (j, k) of
/// `box`: n cells of two arrays. A neighbor in y is `row` numbers further, one in z `plane`.
template <class Add>
void for_each_line(const Box &box, const VectorField &from, const VectorField &to, Add add)
{
  const std::ptrdiff_t row = from.box().extent(0), plane = row * from.box().extent(1);
  const int first = box.lo[0], n = box.extent(0);
  for (int c = 0; c < 3; ++c)
    for_each_row(box, [&, read = from[c], written = to[c]](int j, int k) {
      add(c, j, k, &written(first, j, k), &read(first, j, k), row, plane, n);
    });
}

/// Sum of the values of the six neighbors.
inline double around(const double *at, std::ptrdiff_t row, std::ptrdiff_t plane)
{
  return at[-1] + at[1] + at[-row] + at[row] + at[-plane] + at[plane];
}

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
  if (!result_.bytes()) {
    curvature_ = VectorField(velocity.box());
    result_ = VectorField(velocity.box());
  }
  const Box once = between_plates(without_layers(velocity.box(), grid, 1), grid);
  for_each_line(once, velocity, curvature_,
                [](int, int, int, double *sum, const double *u, std::ptrdiff_t row,
                   std::ptrdiff_t plane, int n) {
                  for (int i = 0; i < n; ++i) sum[i] = around(u + i, row, plane) - 6 * u[i];
                });
  if (grid.plates) reflect_velocity(grid, {}, curvature_);

  const auto [second, fourth] = sheet_correction(kernel);
  const double middle = second + 6 * fourth, next = fourth;
  const Box twice = between_plates(without_layers(velocity.box(), grid, layers), grid);
  for_each_line(twice, curvature_, result_,
                [&](int c, int j, int k, double *result, const double *bent, std::ptrdiff_t row,
                    std::ptrdiff_t plane, int n) {
                  const double *const u = &velocity[c](twice.lo[0], j, k);
                  for (int i = 0; i < n; ++i)
                    result[i] = u[i] - middle * bent[i] + next * around(bent + i, row, plane);
                });
  if (grid.plates) reflect_velocity(grid, plates, result_);
  return result_;
}

}    // namespace fluid
