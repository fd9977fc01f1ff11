#pragma once

#include "geometry/mesh_laplacian.h"

#include <array>
#include <cstddef>
#include <vector>

namespace rbc {

/// Takes from a function of the vertices of a surface what varies faster than a wavenumber k:
///   P = Q + (1 - Q) S (1 - Q),   S = (1 - y)^n (1 + n y),   y = -Laplacian / (largest eigenvalue)
/// S is about exp(-s) (1 + s) with s = 1.7 q^2 / k^2 for variations of wavenumber q: 1 - 1.4 (q /
/// k)^4 for slow ones, a half at q = k, and 0 for the fastest that the mesh has. Q projects on the
/// functions that are linear in the coordinates of the surface at rest, so that P keeps these: the
/// motions of a rigid body, and those of a sheared fluid around it. P is symmetric in the scalar
/// product that weights vertices with their areas.
class SurfaceFilter {
 public:
  /// Values of three functions at a vertex; the fourth is padding.
  using Row = Eigen::Array4d;

  /// `wavenumber` is k, one over length.
  SurfaceFilter(const SurfaceTemplate &surface, double wavenumber);

  int vertex_count() const { return laplacian_.vertex_count(); }

  /// Filters the values at all vertices; `scratch` has as many rows. A row may be of any number of
  /// functions, those of several surfaces, too.
  template <class Row> void apply(std::vector<Row> &values, std::vector<Row> &scratch) const
  {
    const Linear<Row> kept = linear_part(values);
    take_linear(kept, values);
    for (int number = 0; number < passes(); ++number) {
      const auto value = [&values](int w) -> const Row & { return values[w]; };
      for (int v = 0; v < vertex_count(); ++v) scratch[v] = pass(number, v, value);
      values.swap(scratch);
    }
    Linear<Row> change = linear_part(values);
    for (int mode = 0; mode < modes; ++mode) change[mode] -= kept[mode];
    take_linear(change, values);
  }

  // the same in steps, for surfaces that several ranks share

  static constexpr int modes = 4;
  using Mode = std::array<double, modes>;

  /// The values at vertex v of the functions that Q projects on: a basis that is orthonormal in the
  /// scalar product.
  const Mode &linear(int v) const { return linear_[v]; }
  double area(int v) const { return area_[v]; }

  /// S is that many passes over the vertices.
  int passes() const { return degree_ + 1; }

  /// Value at vertex v after this pass, from value(w) at all vertices w before it.
  template <class Value> auto pass(int number, int v, const Value &value) const
  {
    const double share = (number < degree_ ? 1.0 : -degree_) / laplacian_.largest();
    auto change = laplacian_.at(v, value);
    change *= share;
    change += value(v);
    return change;
  }

  std::size_t bytes() const
  {
    return laplacian_.bytes() + linear_.capacity() * sizeof(Mode) +
           area_.capacity() * sizeof(double);
  }

 private:
  template <class Row> using Linear = std::array<Row, modes>;

  MeshLaplacian laplacian_;
  int degree_;    ///< n
  std::vector<Mode> linear_;
  std::vector<double> area_;

  void find_linear_modes(const SurfaceTemplate &surface);

  template <class Row> Linear<Row> linear_part(const std::vector<Row> &values) const
  {
    Linear<Row> parts;
    for (Row &part : parts) part.setZero();
    for (int v = 0; v < vertex_count(); ++v)
      for (int mode = 0; mode < modes; ++mode)
        parts[mode] += (area_[v] * linear_[v][mode]) * values[v];
    return parts;
  }

  template <class Row> void take_linear(const Linear<Row> &parts, std::vector<Row> &values) const
  {
    for (int v = 0; v < vertex_count(); ++v)
      for (int mode = 0; mode < modes; ++mode) values[v] -= linear_[v][mode] * parts[mode];
  }
};

}    // namespace rbc
