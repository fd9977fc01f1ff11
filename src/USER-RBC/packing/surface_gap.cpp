#include "packing/surface_gap.h"

#include "geometry/triangle_distance.h"

namespace rbc {

namespace {

struct BoundedTriangle {
  Triangle corners;
  Vec3 lo, hi;

  bool near(const BoundedTriangle &other, double reach) const
  {
    return ((lo - other.hi).array() < reach).all() && ((other.lo - hi).array() < reach).all();
  }
};

/// Triangles that may come within `reach` of the other cell, by the distance of their corners in
/// its field.
std::vector<BoundedTriangle> facing(const RigidCell &cell, const RigidCell &other, double reach)
{
  const SurfaceTemplate &surface = cell.shape->surface;
  std::vector<Vec3> vertices;
  std::vector<double> distance;
  for (int v = 0; v < surface.vertex_count(); ++v) {
    vertices.push_back(cell.vertex(v));
    distance.push_back(other.size * other.shape->field.at(other.body(vertices.back())).distance);
  }
  // no point of a triangle is further from its nearest corner than an edge
  const double limit =
      reach + cell.size * surface.longest_edge + other.size * other.shape->field.spacing();
  std::vector<BoundedTriangle> found;
  for (const auto &[i, j, k] : surface.triangles) {
    if (std::min({distance[i], distance[j], distance[k]}) > limit) continue;
    const Vec3 &a = vertices[i], &b = vertices[j], &c = vertices[k];
    found.push_back({{a, b, c}, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  return found;
}

}    // namespace

double surface_gap(const RigidCell &a, const RigidCell &b, double reach)
{
  // one inside the other
  if (a.shape->field.at(a.body(b.vertex(0))).distance < 0 ||
      b.shape->field.at(b.body(a.vertex(0))).distance < 0)
    return 0;
  double least = reach;
  const std::vector<BoundedTriangle> others = facing(b, a, reach);
  for (const BoundedTriangle &triangle : facing(a, b, reach))
    for (const BoundedTriangle &other : others)
      if (triangle.near(other, least))
        least = std::min(least, distance(triangle.corners, other.corners));
  return least;
}

double surface_gap(const Vec3 &point, const RigidCell &cell, double reach)
{
  const Vec3 p = cell.body(point);
  if (cell.shape->field.at(p).distance < 0) return 0;
  double least = reach * reach / (cell.size * cell.size);
  const SurfaceTemplate &surface = cell.shape->surface;
  for (const auto &[i, j, k] : surface.triangles)
    least = std::min(least, squared_distance(p, {surface.vertices[i], surface.vertices[j],
                                                 surface.vertices[k]}));
  return cell.size * std::sqrt(least);
}

}    // namespace rbc
