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

  /// Filters the values at all vertices; `scratch` has as many rows.
  void apply(std::vector<Row> &values, std::vector<Row> &scratch) const;

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
  template <class Value> Row pass(int number, int v, const Value &value) const
  {
    const double share = (number < degree_ ? 1.0 : -degree_) / laplacian_.largest();
    return value(v) + share * laplacian_.at(v, value);
  }

  std::size_t bytes() const
  {
    return laplacian_.bytes() + linear_.capacity() * sizeof(Mode) +
           area_.capacity() * sizeof(double);
  }

 private:
  using Linear = std::array<Row, modes>;

  MeshLaplacian laplacian_;
  int degree_;    ///< n
  std::vector<Mode> linear_;
  std::vector<double> area_;

  void find_linear_modes(const SurfaceTemplate &surface);
  Linear take_linear(std::vector<Row> &values) const;
};

}    // namespace rbc
