#include "membrane/cell_elements.h"

#include <algorithm>
#include <numeric>

namespace rbc {

CellElements CellElements::whole(const SurfaceTemplate &shape)
{
  return part(shape, std::vector<char>(shape.vertex_count(), 1), true);
}

CellElements CellElements::part(const SurfaceTemplate &shape, std::vector<char> owned, bool bending)
{
  std::vector<char> core = owned;
  if (bending)
    for (int v = 0; v < shape.vertex_count(); ++v)
      if (owned[v])
        for (int w : shape.neighbors[v]) core[w] = 1;

  CellElements some;
  const auto touches = [&](int triangle, const std::vector<char> &vertices) {
    const auto &[i, j, k] = shape.triangles[triangle];
    return vertices[i] || vertices[j] || vertices[k];
  };
  for (int t = 0; t < static_cast<int>(shape.triangles.size()); ++t)
    if (touches(t, core)) some.triangles.push_back(t);
  some.owned_triangles = std::stable_partition(some.triangles.begin(), some.triangles.end(),
                                               [&](int t) { return touches(t, owned); }) -
                         some.triangles.begin();
  for (int e = 0; e < static_cast<int>(shape.hinges.size()); ++e)
    if (core[shape.hinges[e].a] || core[shape.hinges[e].b]) some.hinges.push_back(e);
  some.owned = std::move(owned);
  some.connect(shape);
  return some;
}

void CellElements::connect(const SurfaceTemplate &shape)
{
  const int count = static_cast<int>(triangles.size());
  std::vector<int> place(shape.triangles.size(), -1);
  for (int n = 0; n < count; ++n) {
    place[triangles[n]] = n;
    for (int c = 0; c < 3; ++c) corners[c].push_back(shape.triangles[triangles[n]][c]);
    triangle_energy_weight.push_back(owned[corners[0][n]]);
  }

  for (std::vector<int> &facing : opposite) facing.assign(owned_triangles, 0);
  for (int m = 0; m < static_cast<int>(hinges.size()); ++m) {
    const Hinge &hinge = shape.hinges[hinges[m]];
    begin.push_back(hinge.a);
    end.push_back(hinge.b);
    hinge_energy_weight.push_back(owned[hinge.a]);
    left.push_back(place[hinge.left]);
    right.push_back(place[hinge.right]);
    for (const auto &[n, vertex] : {std::pair(left[m], hinge.c), std::pair(right[m], hinge.d)})
      for (int c = 0; c < 3 && n < owned_triangles; ++c)
        if (corners[c][n] == vertex) opposite[c][n] = m;
  }

  incident_begin.push_back(0);
  for (int v = 0; v < shape.vertex_count(); ++v) {
    if (owned[v])
      for (int t : shape.incident_triangles[v])
        for (int c = 0; c < 3; ++c)
          if (shape.triangles[t][c] == v) {
            incident_corners.push_back(c * owned_triangles + place[t]);
            incident_triangles.push_back(place[t]);
          }
    incident_begin.push_back(static_cast<int>(incident_corners.size()));
  }
}

}    // namespace rbc
