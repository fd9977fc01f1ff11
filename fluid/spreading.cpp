#include "fluid/spreading.h"

#include "fluid/marker_weights.h"

namespace fluid {

namespace {

using Row = Eigen::Array4d;
using RowMap = Eigen::Map<Eigen::Array4d>;

/// Grid points of a block of markers.
template <typename Kernel> struct Stencils {
  WeightsOfAll<Kernel> w;

  /// Those of marker n, padded rows of four included.
  bool inside(int n, const Box &box) const
  {
    for (int d = 0; d < 3; ++d) {
      const int width = d == 0 ? 4 : Kernel::width;
      const int face = w[d].face.first[n], centre = w[d].centre.first[n];
      if (std::min(face, centre) < box.lo[d] || std::max(face, centre) + width > box.hi[d])
        return false;
    }
    return true;
  }

  /// In direction d, of a vector's component c.
  const typename MarkerWeights<Kernel>::Points &points(int d, int c) const
  {
    return c == d ? w[d].face : w[d].centre;
  }

  /// The first of marker n's points of component c.
  double *corner(int n, int c, const View<double> &field) const
  {
    return &field(points(0, c).first[n], points(1, c).first[n], points(2, c).first[n]);
  }

  /// Adds `row`, times the weights along y and z.
  void add(int n, int c, const Row &row, const View<double> &field) const
  {
    const auto &y = points(1, c), &z = points(2, c);
    const std::ptrdiff_t line = field.box.extent(0), plane = line * field.box.extent(1);
    double *const first = corner(n, c, field);
    for (int k = 0; k < Kernel::width; ++k) {
      const Row here = z.weight[k][n] * row;
      for (int j = 0; j < Kernel::width; ++j)
        RowMap(first + k * plane + j * line) += y.weight[j][n] * here;
    }
  }

  /// Sum of the rows, times the weights along y and z.
  Row sum(int n, int c, const View<double> &field) const
  {
    const auto &y = points(1, c), &z = points(2, c);
    const std::ptrdiff_t line = field.box.extent(0), plane = line * field.box.extent(1);
    const double *const first = corner(n, c, field);
    Row sum = Row::Zero();
    for (int k = 0; k < Kernel::width; ++k) {
      Row here = Row::Zero();
      for (int j = 0; j < Kernel::width; ++j)
        here += y.weight[j][n] * Eigen::Map<const Row>(first + k * plane + j * line);
      sum += z.weight[k][n] * here;
    }
    return sum;
  }

  Row row_weights(int n, int c) const
  {
    const auto &along = points(0, c);
    return {along.weight[0][n], along.weight[1][n], along.weight[2][n], along.weight[3][n]};
  }
};

template <typename Kernel>
int spread_with(const Grid &grid, const MarkerSet &markers, const double *applied, double factor,
                const VectorField &force, const Box &within)
{
  const double density = factor / grid.cell_volume();
  const auto fields = force.views();
  for (int begin = 0; begin < markers.count; begin += lanes) {
    const MarkerPlaces block(markers, begin, grid);
    if (const int far = block.first_far(); far < block.count) return markers.index[begin + far];
    const Stencils<Kernel> stencils{weights_of<Kernel>(block)};
    for (int n = 0; n < block.count; ++n) {
      const int marker = markers.index[begin + n];
      if (!stencils.inside(n, within)) return marker;
      for (int c = 0; c < 3; ++c) {
        const double here = density * applied[3 * std::ptrdiff_t(marker) + c];
        stencils.add(n, c, here * stencils.row_weights(n, c), fields[c]);
      }
    }
  }
  return -1;
}

template <typename Kernel>
void interpolate_with(const Grid &grid, const MarkerSet &markers, const VectorField &velocity,
                      double *interpolated)
{
  const auto fields = velocity.views();
  for (int begin = 0; begin < markers.count; begin += lanes) {
    const MarkerPlaces block(markers, begin, grid);
    const Stencils<Kernel> stencils{weights_of<Kernel>(block)};
    for (int n = 0; n < block.count; ++n)
      for (int c = 0; c < 3; ++c)
        interpolated[3 * std::ptrdiff_t(markers.index[begin + n]) + c] =
            (stencils.sum(n, c, fields[c]) * stencils.row_weights(n, c)).sum();
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
