#include "fluid/plates.h"

#include "fluid/second_differences.h"

#include <algorithm>
#include <vector>

namespace fluid {

namespace {

constexpr int layers = Halo::plate_layers;

struct PlanePair {
  int beyond, inside;
};

/// The planes of component c beyond the lower (upper) plate and their mirror images; w has a plane
/// of faces on the plate itself.
PlanePair mirrored(const Grid &grid, int c, bool upper, int layer)
{
  const int n = grid.cells[2];
  if (c == 2) return upper ? PlanePair{n + layer, n - layer} : PlanePair{-layer, layer};
  return upper ? PlanePair{n - 1 + layer, n - layer} : PlanePair{-layer, layer - 1};
}

/// The factor of images beyond a plate for component c.
double image_factor(const Grid &grid, int c, bool upper)
{
  return c == 2 ? -1 : grid.plate_conditions.factors().at(upper);
}

/// Number of planes of component c beyond a plate that the ghost cells hold.
int planes_beyond(int c, bool upper)
{
  return c != 2 && upper ? layers + 1 : layers;
}

double *row_of(const View<double> &field, int j, int k)
{
  return &field(field.box.lo[0], j, k);
}

double sum_of(const double *row, int n)
{
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int i = 0; i < n; ++i) sum += row[i];
  return sum;
}

/// onto += factor * from, and from = 0; different rows.
void move_row(double factor, double *from, double *onto, int n)
{
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    onto[i] += factor * from[i];
    from[i] = 0;
  }
}

/// The box holds the faces on the plate.
bool reaches(const Grid &grid, const Box &box, bool upper)
{
  return !box.empty() && (upper ? box.hi[2] > grid.cells[2] : box.lo[2] <= 0);
}

}    // namespace

PlateImage plate_image(const Grid &grid, int c, int k)
{
  for (bool upper : {false, true}) {
    if (c == 2 && k == (upper ? grid.cells[2] : 0)) return {k, 0};
    for (int layer = 1; layer <= planes_beyond(c, upper); ++layer) {
      const auto [beyond, inside] = mirrored(grid, c, upper, layer);
      if (k == beyond) return {inside, image_factor(grid, c, upper)};
    }
  }
  return {k, 1};
}

void reflect_velocity(const Grid &grid, const PlateVelocities &plates, const VectorField &velocity)
{
  const Box &box = velocity.box();
  const int n = box.extent(0);
  for (bool upper : {false, true}) {
    if (!reaches(grid, box, upper)) continue;
    const Real3 &plate_velocity = upper ? plates.upper : plates.lower;
    for (int c = 0; c < 3; ++c) {
      const View<double> u = velocity[c];
      const double factor = image_factor(grid, c, upper),
                   of_plate = (1 - factor) * plate_velocity[c];
      if (c == 2) {
        const int plate = upper ? grid.cells[2] : 0;
        for (int j = box.lo[1]; j < box.hi[1]; ++j) std::fill_n(row_of(u, j, plate), n, 0.0);
      }
      for (int layer = 1; layer <= planes_beyond(c, upper); ++layer) {
        const auto [beyond, inside] = mirrored(grid, c, upper, layer);
        if (beyond < box.lo[2] || beyond >= box.hi[2]) continue;
        for (int j = box.lo[1]; j < box.hi[1]; ++j) {
          double *const image = row_of(u, j, beyond);
          const double *const row = row_of(u, j, inside);
#pragma omp simd
          for (int i = 0; i < n; ++i) image[i] = of_plate + factor * row[i];
        }
      }
    }
  }
}

void fold_force(const Grid &grid, const VectorField &force, Real3 &lower, Real3 &upper_sum)
{
  const Box &box = force.box();
  const int n = box.extent(0);
  for (bool upper : {false, true}) {
    if (!reaches(grid, box, upper)) continue;
    Real3 &sum = upper ? upper_sum : lower;
    for (int c = 0; c < 3; ++c) {
      const View<double> f = force[c];
      const double factor = image_factor(grid, c, upper);
      if (c == 2) {
        const int plate = upper ? grid.cells[2] : 0;
        for (int j = box.lo[1]; j < box.hi[1]; ++j) {
          sum[c] += sum_of(row_of(f, j, plate), n);
          std::fill_n(row_of(f, j, plate), n, 0.0);
        }
      }
      for (int layer = 1; layer <= planes_beyond(c, upper); ++layer) {
        const auto [beyond, inside] = mirrored(grid, c, upper, layer);
        if (beyond < box.lo[2] || beyond >= box.hi[2]) continue;
        for (int j = box.lo[1]; j < box.hi[1]; ++j) {
          sum[c] += (1 - factor) * sum_of(row_of(f, j, beyond), n);
          move_row(factor, row_of(f, j, beyond), row_of(f, j, inside), n);
        }
      }
    }
  }
}

void balance_correction(const Grid &grid, const Box &brick, KernelKind kernel,
                        const VectorField &force, Real3 &lower, Real3 &upper_sum)
{
  const auto [second, fourth] = sheet_correction(kernel);
  const int n = brick.extent(0);
  std::vector<double> curvature(n);
  for (bool upper : {false, true}) {
    if (brick.empty() || (upper ? brick.hi[2] != grid.cells[2] : brick.lo[2] != 0)) continue;
    Real3 &sum = upper ? upper_sum : lower;
    for (int c = 0; c < 3; ++c) {
      const int next = upper ? grid.cells[2] - 1 : c == 2 ? 1 : 0;
      const double step = c == 2 ? 1 : 1 - image_factor(grid, c, upper);    // at the plate
      for (int j = brick.lo[1]; j < brick.hi[1]; ++j) {
        second_differences(force[c], brick.lo[0], j, next, n, curvature.data());
        sum[c] += step * (fourth * sum_of(curvature.data(), n) -
                          second * sum_of(&force[c](brick.lo[0], j, next), n));
      }
    }
  }
}

void fold_source(const Grid &grid, const ScalarField &source)
{
  const Box &box = source.box();
  const View<double> s = source[0];
  for (bool upper : {false, true}) {
    if (!reaches(grid, box, upper)) continue;
    for (int layer = 1; layer <= planes_beyond(0, upper); ++layer) {
      const auto [beyond, inside] = mirrored(grid, 0, upper, layer);
      if (beyond < box.lo[2] || beyond >= box.hi[2]) continue;
      for (int j = box.lo[1]; j < box.hi[1]; ++j)
        move_row(1, row_of(s, j, beyond), row_of(s, j, inside), box.extent(0));
    }
  }
}

}    // namespace fluid
