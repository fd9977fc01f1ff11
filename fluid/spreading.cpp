#include "fluid/spreading.h"

#include "fluid/marker_weights.h"

namespace fluid {

namespace {

using Row = Eigen::Array4d;
using RowMap = Eigen::Map<Eigen::Array4d>;

template <typename Kernel> struct Stencil {
  std::array<Weights<Kernel>, 3> w;

  Stencil(const double *x, const Grid &grid, const Real3 &inverse_spacing) :
      w{{{x[0], grid.origin[0], inverse_spacing[0]},
         {x[1], grid.origin[1], inverse_spacing[1]},
         {x[2], grid.origin[2], inverse_spacing[2]}}}
  {
  }

  bool inside(const Box &box) const
  {
    return w[0].inside(box.lo[0], box.hi[0], true) && w[1].inside(box.lo[1], box.hi[1], false) &&
           w[2].inside(box.lo[2], box.hi[2], false);
  }

  /// Visits the rows of grid points of component c: visit(pointer to the row, weight of the row).
  template <typename Visit> void for_each_row(int c, const View<double> &field, Visit visit) const
  {
    const Row &wy = c == 1 ? w[1].face : w[1].centre, &wz = c == 2 ? w[2].face : w[2].centre;
    const int i = c == 0 ? w[0].first_face : w[0].first_centre;
    const int j = c == 1 ? w[1].first_face : w[1].first_centre;
    const int k = c == 2 ? w[2].first_face : w[2].first_centre;
    const std::ptrdiff_t row = field.box.extent(0), plane = row * field.box.extent(1);
    double *corner = &field(i, j, k);
    for (int n = 0; n < Kernel::width; ++n)
      for (int m = 0; m < Kernel::width; ++m) visit(corner + n * plane + m * row, wz[n] * wy[m]);
  }

  const Row &row_weights(int c) const { return c == 0 ? w[0].face : w[0].centre; }
};

template <typename Kernel>
int spread_with(const Grid &grid, const MarkerSet &markers, const double *applied, double factor,
                const VectorField &force, const Box &within)
{
  const Real3 inverse_spacing = inverse(grid.spacing);
  const double density = factor / grid.cell_volume();
  const auto fields = force.views();
  for (int n = 0; n < markers.count; ++n) {
    const std::ptrdiff_t i = 3 * std::ptrdiff_t(markers.index[n]);
    if (!near(markers.position + i, grid, inverse_spacing)) return markers.index[n];
    const Stencil<Kernel> stencil(markers.position + i, grid, inverse_spacing);
    if (!stencil.inside(within)) return markers.index[n];
    for (int c = 0; c < 3; ++c) {
      const Row row = stencil.row_weights(c) * (density * applied[i + c]);
      stencil.for_each_row(c, fields[c], [&](double *points, double weight) {
        RowMap map(points);
        map += weight * row;
      });
    }
  }
  return -1;
}

template <typename Kernel>
void interpolate_with(const Grid &grid, const MarkerSet &markers, const VectorField &velocity,
                      double *interpolated)
{
  const Real3 inverse_spacing = inverse(grid.spacing);
  const auto fields = velocity.views();
  for (int n = 0; n < markers.count; ++n) {
    const std::ptrdiff_t i = 3 * std::ptrdiff_t(markers.index[n]);
    const Stencil<Kernel> stencil(markers.position + i, grid, inverse_spacing);
    for (int c = 0; c < 3; ++c) {
      Row sum = Row::Zero();
      stencil.for_each_row(c, fields[c], [&](const double *points, double weight) {
        sum += weight * Eigen::Map<const Eigen::Array4d>(points);
      });
      interpolated[i + c] = (sum * stencil.row_weights(c)).sum();
    }
  }
}

}    // namespace

double surface_offset(KernelKind kernel)
{
  return kernel == KernelKind::peskin4 ? Peskin4::surface_offset : Roma3::surface_offset;
}

template <class Kernel> static constexpr SheetCorrection correction_of()
{
  return {Kernel::second_correction, Kernel::fourth_correction};
}

SheetCorrection sheet_correction(KernelKind kernel)
{
  return kernel == KernelKind::peskin4 ? correction_of<Peskin4>() : correction_of<Roma3>();
}

int spread(const Grid &grid, const MarkerSet &markers, const double *applied, double factor,
           const VectorField &force, const Box &within)
{
  switch (markers.kernel) {
    case KernelKind::roma3:
      return spread_with<Roma3>(grid, markers, applied, factor, force, within);
    case KernelKind::peskin4:
      break;
  }
  return spread_with<Peskin4>(grid, markers, applied, factor, force, within);
}

void interpolate(const Grid &grid, const MarkerSet &markers, const VectorField &velocity,
                 double *interpolated)
{
  switch (markers.kernel) {
    case KernelKind::roma3:
      return interpolate_with<Roma3>(grid, markers, velocity, interpolated);
    case KernelKind::peskin4:
      break;
  }
  interpolate_with<Peskin4>(grid, markers, velocity, interpolated);
}

}    // namespace fluid
