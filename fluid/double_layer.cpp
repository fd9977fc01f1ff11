#include "fluid/double_layer.h"

#include "fluid/marker_weights.h"

namespace fluid {

namespace {

/// Weights of a marker in one direction, and their differences over the spacing: the weights with
/// which what is spread onto centres (faces) changes across a face (centre).
template <typename Kernel> struct DifferencedWeights {
  static constexpr int width = Kernel::width + 1;
  using Row = Eigen::Array<double, width, 1>;

  int first_face, first_centre;    ///< of the rows on faces and on centres
  Row face, centre_change;         ///< on faces
  Row centre, face_change;         ///< on centres

  DifferencedWeights(const MarkerWeights<Kernel> &plain, int marker, double inverse_spacing)
  {
    const auto of_face = [&](int n) { return plain.face.weight[n][marker]; };
    const auto of_centre = [&](int n) { return plain.centre.weight[n][marker]; };
    first_face = plain.centre.first[marker];
    first_centre = plain.face.first[marker] - 1;
    face.setZero();
    centre.setZero();
    for (int n = 0; n < Kernel::width; ++n) {
      face[n + plain.face.first[marker] - first_face] = of_face(n);
      centre[n + plain.centre.first[marker] - first_centre] = of_centre(n);
    }
    for (int n = 0; n < width; ++n) {
      const bool starts = n > 0, ends = n == Kernel::width;
      centre_change[n] =
          inverse_spacing * ((ends ? 0 : of_centre(n)) - (starts ? of_centre(n - 1) : 0));
      face_change[n] = inverse_spacing * ((ends ? 0 : of_face(n)) - (starts ? of_face(n - 1) : 0));
    }
  }

  bool inside(int lo, int hi) const
  {
    return std::min(first_face, first_centre) >= lo &&
           std::max(first_face, first_centre) + width <= hi;
  }
};

template <typename Kernel> struct LayerStencil {
  using Directions = DifferencedWeights<Kernel>;
  using Row = typename Directions::Row;
  static constexpr int width = Directions::width;

  std::array<Directions, 3> w;

  LayerStencil(const WeightsOfAll<Kernel> &plain, int marker, const Grid &grid) :
      w{Directions(plain[0], marker, 1 / grid.spacing[0]),
        Directions(plain[1], marker, 1 / grid.spacing[1]),
        Directions(plain[2], marker, 1 / grid.spacing[2])}
  {
  }

  bool inside(const Box &box) const
  {
    return w[0].inside(box.lo[0], box.hi[0]) && w[1].inside(box.lo[1], box.hi[1]) &&
           w[2].inside(box.lo[2], box.hi[2]);
  }

  /// Adds to component c the divergence of the tensor whose row c is t.
  void add_divergence(int c, const Real3 &t, const View<double> &field) const
  {
    const int j = c == 1 ? w[1].first_face : w[1].first_centre;
    const int k = c == 2 ? w[2].first_face : w[2].first_centre;
    const Row &y = c == 1 ? w[1].face : w[1].centre, &z = c == 2 ? w[2].face : w[2].centre;
    const Row y_change = t[1] * (c == 1 ? w[1].centre_change : w[1].face_change);
    const Row z_change = t[2] * (c == 2 ? w[2].centre_change : w[2].face_change);
    const Row x = c == 0 ? w[0].face : w[0].centre;
    const Row x_change = t[0] * (c == 0 ? w[0].centre_change : w[0].face_change);
    const std::ptrdiff_t row = field.box.extent(0), plane = row * field.box.extent(1);
    double *const corner = &field(c == 0 ? w[0].first_face : w[0].first_centre, j, k);
    for (int n = 0; n < width; ++n)
      for (int m = 0; m < width; ++m) {
        Eigen::Map<Row> points(corner + n * plane + m * row);
        points += (y[m] * z[n]) * x_change + (y_change[m] * z[n] + y[m] * z_change[n]) * x;
      }
  }

  void add(double value, const View<double> &centres) const
  {
    const Row x = value * w[0].centre;
    const std::ptrdiff_t row = centres.box.extent(0), plane = row * centres.box.extent(1);
    double *const corner = &centres(w[0].first_centre, w[1].first_centre, w[2].first_centre);
    for (int n = 0; n < width; ++n)
      for (int m = 0; m < width; ++m)
        Eigen::Map<Row>(corner + n * plane + m * row) += (w[1].centre[m] * w[2].centre[n]) * x;
  }
};

template <typename Kernel>
int spread_with(const Grid &grid, const MarkerSet &markers, const DoubleLayer &layer,
                double viscosity, const VectorField &force, const ScalarField &source,
                const Box &within)
{
  const double density = 1 / grid.cell_volume(), stress = viscosity * density;
  const auto fields = force.views();
  for (int begin = 0; begin < markers.count; begin += lanes) {
    const MarkerPlaces block(markers, begin, grid);
    if (const int far = block.first_far(); far < block.count) return markers.index[begin + far];
    const auto weights = weights_of<Kernel>(block);
    for (int n = 0; n < block.count; ++n) {
      const int marker = markers.index[begin + n];
      const LayerStencil<Kernel> stencil(weights, n, grid);
      if (!stencil.inside(within)) return marker;
      const std::ptrdiff_t row = 3 * std::ptrdiff_t(marker);
      const double *const v = layer.velocity + row;
      const double *const s = layer.strength + row;
      for (int c = 0; c < 3; ++c) {
        const Real3 t{stress * (v[c] * s[0] + s[c] * v[0]), stress * (v[c] * s[1] + s[c] * v[1]),
                      stress * (v[c] * s[2] + s[c] * v[2])};
        stencil.add_divergence(c, t, fields[c]);
      }
      const double flux = v[0] * s[0] + v[1] * s[1] + v[2] * s[2];
      stencil.add(-density * flux, source[0]);
    }
  }
  return -1;
}

}    // namespace

int spread(const Grid &grid, const MarkerSet &markers, const DoubleLayer &layer, double viscosity,
           const VectorField &force, const ScalarField &source, const Box &within)
{
  const auto with = [&](auto kernel) {
    return spread_with<decltype(kernel)>(grid, markers, layer, viscosity, force, source, within);
  };
  return markers.kernel == KernelKind::peskin4 ? with(Peskin4{}) : with(Roma3{});
}

}    // namespace fluid
