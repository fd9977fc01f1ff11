#include "geometry/mesh_laplacian.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace rbc {

static double cotangent(const Vec3 &at, const Vec3 &b, const Vec3 &c)
{
  return (b - at).dot(c - at) / (b - at).cross(c - at).norm();
}

MeshLaplacian::MeshLaplacian(const SurfaceTemplate &surface)
{
  struct Edge {
    int from, to;
    double weight;
  };
  const std::vector<Vec3> &x = surface.vertices;
  std::vector<Edge> edges;
  edges.reserve(2 * surface.hinges.size());
  for (const Hinge &hinge : surface.hinges) {
    const double half_sum = 0.5 * (cotangent(x[hinge.c], x[hinge.a], x[hinge.b]) +
                                   cotangent(x[hinge.d], x[hinge.a], x[hinge.b]));
    edges.push_back({hinge.a, hinge.b, half_sum / surface.vertex_area[hinge.a]});
    edges.push_back({hinge.b, hinge.a, half_sum / surface.vertex_area[hinge.b]});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge &one, const Edge &other) {
    return one.from != other.from ? one.from < other.from : one.to < other.to;
  });

  begin_.assign(surface.vertex_count() + 1, 0);
  for (const Edge &edge : edges) {
    ++begin_[edge.from + 1];
    neighbor_.push_back(edge.to);
    weight_.push_back(edge.weight);
  }
  for (int v = 0; v < surface.vertex_count(); ++v) begin_[v + 1] += begin_[v];
  for (int v = 0; v < surface.vertex_count(); ++v) {
    double bound = 0;
    for (int n = begin_[v]; n < begin_[v + 1]; ++n) bound += weight_[n] + std::abs(weight_[n]);
    largest_ = std::max(largest_, bound);
  }
}

}    // namespace rbc
