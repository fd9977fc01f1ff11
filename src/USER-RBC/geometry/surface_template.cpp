#include "geometry/surface_template.h"

#include "geometry/arc_tangent.h"
#include "geometry/corner_share.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace rbc {

namespace {

using Corners = SurfaceTemplate::Corners;

// over the longest edge: of a triangle that is flatter, rounding leaves no angles
constexpr double least_height = 1e-6;
// squares of areas and volumes of larger ones are no numbers
constexpr double largest_coordinate = 1e60;

void require(bool condition, const std::string &problem)
{
  if (!condition) throw std::invalid_argument(problem);
}

/// Every directed edge with the triangle to its left.
std::map<std::pair<int, int>, int> directed_edges(int vertices,
                                                  const std::vector<Corners> &triangles)
{
  std::map<std::pair<int, int>, int> left;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int e = 0; e < 3; ++e) {
      const int a = triangles[t][e], b = triangles[t][(e + 1) % 3];
      require(a >= 0 && a < vertices,
              "triangle " + std::to_string(t + 1) + " names a vertex that does not exist");
      require(a != b, "triangle " + std::to_string(t + 1) + " uses a vertex twice");
      require(left.emplace(std::make_pair(a, b), t).second,
              "edge " + std::to_string(a + 1) + "-" + std::to_string(b + 1) +
                  " is used twice in the same direction: the surface is not consistently oriented");
    }
  return left;
}

int opposite(const Corners &triangle, int a, int b)
{
  for (int v : triangle)
    if (v != a && v != b) return v;
  return -1;
}

bool connected(const std::vector<std::vector<int>> &neighbors)
{
  std::vector<char> seen(neighbors.size());
  std::vector<int> open{0};
  seen[0] = 1;
  std::size_t count = 0;
  while (!open.empty()) {
    const int v = open.back();
    open.pop_back();
    ++count;
    for (int w : neighbors[v])
      if (!seen[w]) {
        seen[w] = 1;
        open.push_back(w);
      }
  }
  return count == neighbors.size();
}

/// Throws unless the triangles around each vertex form one fan.
void require_fans(const SurfaceTemplate &surface, const std::map<std::pair<int, int>, int> &left)
{
  for (int v = 0; v < surface.vertex_count(); ++v) {
    std::size_t around = 0;
    int w = surface.neighbors[v][0];
    do {
      w = opposite(surface.triangles[left.at({v, w})], v, w);
      ++around;
    } while (w != surface.neighbors[v][0]);
    require(around == surface.incident_triangles[v].size(),
            "the surface touches itself at vertex " + std::to_string(v + 1));
  }
}

}    // namespace

SurfaceTemplate::SurfaceTemplate(std::vector<Vec3> vertices_in, std::vector<Corners> triangles_in) :
    vertices(std::move(vertices_in)), triangles(std::move(triangles_in)),
    vertex_area(vertices.size()), curvature(vertices.size()), neighbors(vertices.size()),
    incident_triangles(vertices.size())
{
  connect_vertices();
  measure_hinges(measure_triangles());
}

void SurfaceTemplate::connect_vertices()
{
  require(triangles.size() >= 4, "a closed surface needs at least 4 triangles");
  const auto left = directed_edges(vertex_count(), triangles);

  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int v : triangles[t]) incident_triangles[v].push_back(t);
  for (const auto &[edge, triangle] : left) {
    const auto [a, b] = edge;
    const auto twin = left.find({b, a});
    require(twin != left.end(), "edge " + std::to_string(a + 1) + "-" + std::to_string(b + 1) +
                                    " belongs to one triangle only: the surface is not closed");
    neighbors[a].push_back(b);
    if (a < b)
      hinges.push_back({a, b, opposite(triangles[triangle], a, b),
                        opposite(triangles[twin->second], a, b), triangle, twin->second});
  }
  for (int v = 0; v < vertex_count(); ++v)
    require(!incident_triangles[v].empty(),
            "vertex " + std::to_string(v + 1) + " belongs to no triangle");
  require(connected(neighbors), "the surface is in more than one piece");
  require(vertex_count() - static_cast<int>(hinges.size()) + static_cast<int>(triangles.size()) ==
              2,
          "the surface is not a sphere topologically (vertices - edges + triangles must be 2)");
  require_fans(*this, left);
}

/// Returns the normal of each triangle.
std::vector<Vec3> SurfaceTemplate::measure_triangles()
{
  for (int v = 0; v < vertex_count(); ++v)
    require(!(vertices[v].array().abs() > largest_coordinate).any(),
            "vertex " + std::to_string(v + 1) + " is too far away");
  std::vector<Vec3> normals(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto &[i, j, k] = triangles[t];
    const Vec3 e1 = vertices[j] - vertices[i], e2 = vertices[k] - vertices[i];
    const Vec3 cross = e1.cross(e2);
    const double twice_area = cross.norm();
    const double longest = std::max({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()});
    const double determinant = twice_area * twice_area;
    require(twice_area > least_height * longest && determinant > 0,
            "triangle " + std::to_string(t + 1) + " has no area");
    reference.push_back({e2.squaredNorm() / determinant, -e1.dot(e2) / determinant,
                         e1.squaredNorm() / determinant, twice_area / 2});
    normals[t] = cross / twice_area;
    area += twice_area / 2;
    volume += vertices[i].dot(vertices[j].cross(vertices[k])) / 6;
    const std::array<double, 3> shares = mixed_corner_shares(e1, e2);
    for (int c = 0; c < 3; ++c) {
      corner_share[c].push_back(shares[c]);
      vertex_area[triangles[t][c]] += shares[c] * twice_area / 2;
    }
  }
  require(volume > 0, "the triangles are oriented inward (volume " + std::to_string(volume) + ")");
  return normals;
}

void SurfaceTemplate::measure_hinges(const std::vector<Vec3> &normals)
{
  for (const Hinge &hinge : hinges) {
    const Vec3 edge = vertices[hinge.b] - vertices[hinge.a];
    const double length = edge.norm();
    const Vec3 &left_normal = normals[hinge.left], &right_normal = normals[hinge.right];
    const double angle = arc_tangent(left_normal.cross(right_normal).dot(edge) / length,
                                     left_normal.dot(right_normal));
    const auto cotangent = [&](int corner) {
      const Vec3 a = vertices[hinge.a] - vertices[corner], b = vertices[hinge.b] - vertices[corner];
      return a.dot(b) / a.cross(b).norm();
    };
    reference_hinges.push_back({angle, length / 2 * (cotangent(hinge.c) + cotangent(hinge.d))});
    for (int v : {hinge.a, hinge.b}) curvature[v] += length * angle / 4 / vertex_area[v];
    longest_edge = std::max(longest_edge, length);
    mean_edge += length / hinges.size();
  }
}

void SurfaceTemplate::take_reference(const SurfaceTemplate &stress_free)
{
  const auto name = [](const Corners &corners) {
    return std::to_string(corners[0] + 1) + "-" + std::to_string(corners[1] + 1) + "-" +
           std::to_string(corners[2] + 1);
  };
  require(stress_free.vertex_count() == vertex_count(),
          "it has " + std::to_string(stress_free.vertex_count()) + " vertices, not " +
              std::to_string(vertex_count()));
  require(stress_free.triangles.size() == triangles.size(),
          "it has " + std::to_string(stress_free.triangles.size()) + " triangles, not " +
              std::to_string(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    require(stress_free.triangles[t] == triangles[t],
            "its triangle " + name(stress_free.triangles[t]) + " stands in place of " +
                name(triangles[t]));
  reference = stress_free.reference;
}

}    // namespace rbc
