#include "vessel/mesh_connectivity.h"

#include "geometry/point_bins.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace rbc {

namespace {

constexpr double weld_share = 1e-6;    // of the diagonal: corners nearer to each other are one

void require(bool condition, const std::string &problem)
{
  if (!condition) throw std::invalid_argument(problem);
}

std::string text(const Vec3 &x)
{
  char numbers[80];
  std::snprintf(numbers, sizeof numbers, "(%.6g, %.6g, %.6g)", x[0], x[1], x[2]);
  return numbers;
}

}    // namespace

MeshConnectivity::MeshConnectivity(std::vector<Triangle> &triangles, const PackingBox &box)
{
  weld(triangles);
  const auto ends = join();
  close(ends, box);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) triangles[t][c] = places_[corners_[t][c]];
}

std::string MeshConnectivity::name(const Edge &edge) const
{
  return "the edge from " + text(places_[edge.first]) + " to " + text(places_[edge.second]);
}

/* ---------------------------------------------------------------------- */

void MeshConnectivity::weld(std::vector<Triangle> &triangles)
{
  require(!triangles.empty(), "there are no triangles");
  Vec3 lo = triangles[0][0], hi = lo;
  double edge = 0;
  for (const Triangle &triangle : triangles) {
    edge += (triangle[1] - triangle[0]).norm() / triangles.size();
    for (const Vec3 &corner : triangle) {
      lo = lo.cwiseMin(corner);
      hi = hi.cwiseMax(corner);
    }
  }
  const double diagonal = (hi - lo).norm();
  require(diagonal > 0, "no triangle has an area");
  require(std::isfinite(std::pow(diagonal, 3)),
          "its corners are too far apart: " + text(lo) + " and " + text(hi));
  const double tolerance = weld_share * diagonal;
  PointBins bins({lo, (hi - lo).array() + 2 * tolerance, {false, false, false}},
                 std::max(edge, 4 * tolerance));
  std::vector<Triangle> kept;
  for (const Triangle &triangle : triangles) {
    Corners corners;
    for (int c = 0; c < 3; ++c) {
      corners[c] = -1;
      bins.visit(triangle[c], tolerance, [&](int number, const Vec3 &) { corners[c] = number; });
      if (corners[c] >= 0) continue;
      corners[c] = vertices();
      places_.push_back(triangle[c]);
      bins.add(triangle[c]);
    }
    const auto &[a, b, c] = corners;
    if (a == b || b == c || c == a) continue;
    corners_.push_back(corners);
    kept.push_back(triangle);
  }
  triangles = std::move(kept);
  require(!triangles.empty(), "no triangle has an area");
}

/* ----------------------------------------------------------------------
   triangles that share an edge; returns edges of one triangle
------------------------------------------------------------------------- */

std::map<MeshConnectivity::Edge, MeshConnectivity::Place> MeshConnectivity::join()
{
  std::map<Edge, Place> left;    // the triangle to the left of each directed edge
  for (int t = 0; t < static_cast<int>(corners_.size()); ++t)
    for (int e = 0; e < 3; ++e) {
      const Edge edge{corners_[t][e], corners_[t][(e + 1) % 3]};
      if (left.emplace(edge, Place{t, e}).second) continue;
      require(left.count({edge.second, edge.first}) == 0,
              "more than two triangles share " + name(edge));
      throw std::invalid_argument("the triangles on both sides of " + name(edge) +
                                  " are not oriented alike");
    }
  neighbors_.resize(corners_.size());
  std::map<Edge, Place> ends;
  for (const auto &[edge, place] : left) {
    const auto other = left.find({edge.second, edge.first});
    if (other == left.end())
      ends.emplace(edge, place);
    else
      neighbors_[place.first][place.second] = other->second.first;
  }
  return ends;
}

/* ----------------------------------------------------------------------
   joins the ends of the surface on opposite faces
------------------------------------------------------------------------- */

void MeshConnectivity::close(const std::map<Edge, Place> &ends, PackingBox box)
{
  twins_.resize(vertices());
  for (int v = 0; v < vertices(); ++v) twins_[v] = v;
  if (ends.empty()) return;

  std::vector<int> on_faces;
  for (const auto &end : ends) {
    bool found = false;
    const auto &[a, b] = end.first;
    for (int d = 0; d < 3 && !found; ++d)
      for (const double face : {box.lo[d], box.lo[d] + box.length[d]}) {
        const double tolerance = face_share * box.length[d];
        if (!box.periodic[d] || std::abs(places_[a][d] - face) > tolerance ||
            std::abs(places_[b][d] - face) > tolerance)
          continue;
        open_[d] = found = true;
        for (int v : {a, b}) {
          places_[v][d] = face;
          on_faces.push_back(v);
        }
        break;
      }
    require(found, "the surface is not closed: " + name(end.first) +
                       " belongs to one triangle only, and lies on no periodic face of the box");
  }

  box.periodic = open_;
  const double tolerance = face_share * box.length.norm();
  PointBins bins(box, std::max(4 * tolerance, box.length.norm() / 100));
  std::vector<int> first;
  for (int v : on_faces) {
    bool known = false;
    bins.visit(places_[v], tolerance, [&](int n, const Vec3 &) {
      twins_[v] = first[n];
      known = true;
    });
    if (known) continue;
    bins.add(places_[v]);
    first.push_back(v);
  }

  std::map<Edge, Place> by_twins;
  for (const auto &[edge, place] : ends)
    by_twins.emplace(Edge{twins_[edge.first], twins_[edge.second]}, place);
  for (const auto &[edge, place] : ends) {
    const auto other = by_twins.find({twins_[edge.second], twins_[edge.first]});
    require(other != by_twins.end(),
            name(edge) +
                " lies on a periodic face of the box, where the surface goes on behind the "
                "face opposite, but has no counterpart there");
    neighbors_[place.first][place.second] = other->second.first;
  }
}

}    // namespace rbc
