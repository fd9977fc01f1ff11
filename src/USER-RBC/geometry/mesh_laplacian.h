#pragma once

#include "geometry/surface_template.h"

#include <cstddef>
#include <vector>

namespace rbc {

/// The Laplace-Beltrami operator on functions of the vertices of a surface at rest, by linear
/// finite elements with lumped areas: the weight of an edge is half the sum of the cotangents of
/// the angles that face it, over the area of the vertex (Pinkall and Polthier, Experimental
/// Mathematics 2, 15 (1993)). It is symmetric in the scalar product that weights vertices with
/// their areas, and never positive.
class MeshLaplacian {
 public:
  explicit MeshLaplacian(const SurfaceTemplate &surface);

  int vertex_count() const { return static_cast<int>(begin_.size()) - 1; }

  /// Laplacian at vertex v, per area, of the function whose value at vertex w is value(w).
  template <class Value> auto at(int v, const Value &value) const
  {
    const auto here = value(v);
    auto sum = here;
    sum.setZero();
    for (int n = begin_[v]; n < begin_[v + 1]; ++n)
      sum += weight_[n] * (value(neighbor_[n]) - here);
    return sum;
  }

  /// Bound on the size of the eigenvalues, one over area (Gershgorin).
  double largest() const { return largest_; }

  std::size_t bytes() const
  {
    return (begin_.capacity() + neighbor_.capacity()) * sizeof(int) +
           weight_.capacity() * sizeof(double);
  }

 private:
  std::vector<int> begin_;    ///< of each vertex in the two below, and the end
  std::vector<int> neighbor_;
  std::vector<double> weight_;
  double largest_ = 0;
};

}    // namespace rbc
