#pragma once

#include "fluid/rigid_surface.h"
#include "test_support.h"

namespace test {

/// Markers on a tube along x: staggered rings, with about one marker to an area of spacing^2.
inline Points tube(const Grid &grid, double radius, double spacing)
{
  const double length = grid.cells[0] * grid.spacing[0];
  const int rings = 2 * static_cast<int>(std::lround(length / (2 * spacing)));
  const int around = static_cast<int>(std::lround(2 * pi * radius / spacing));
  Points points;
  for (int ring = 0; ring < rings; ++ring)
    for (int n = 0; n < around; ++n) {
      const double angle = 2 * pi * (n + 0.5 * (ring % 2)) / around;
      points.position.push_back(
          {grid.origin[0] + length * (ring + 0.3) / rings,
           grid.origin[1] + 0.5 * grid.cells[1] * grid.spacing[1] + radius * std::cos(angle),
           grid.origin[2] + 0.5 * grid.cells[2] * grid.spacing[2] + radius * std::sin(angle)});
    }
  return points;
}

/// Distance from the axis of the tube.
inline double from_axis(const Grid &grid, const Real3 &x)
{
  return std::hypot(x[1] - grid.origin[1] - 0.5 * grid.cells[1] * grid.spacing[1],
                    x[2] - grid.origin[2] - 0.5 * grid.cells[2] * grid.spacing[2]);
}

/// Rows of the markers of this rank.
inline std::vector<double> rows_here(const std::vector<Real3> &all, const Points &points)
{
  std::vector<double> rows;
  for (int n : points.index) rows.insert(rows.end(), all[n].begin(), all[n].end());
  return rows;
}

}    // namespace test
