#include "contact/surface_patches.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace rbc {

std::vector<std::vector<int>> surface_patches(const SurfaceTemplate &surface, double distance)
{
  constexpr double far = std::numeric_limits<double>::max();
  std::vector<std::vector<int>> patches(surface.vertex_count());
  std::vector<double> path(surface.vertex_count(), far);
  std::vector<int> reached;
  using Step = std::pair<double, int>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> next;

  for (int start = 0; start < surface.vertex_count(); ++start) {
    path[start] = 0;
    next.emplace(0, start);
    while (!next.empty()) {    // Dijkstra's algorithm
      const auto [length, v] = next.top();
      next.pop();
      if (length > path[v]) continue;
      reached.push_back(v);
      for (int w : surface.neighbors[v]) {
        const double longer = length + (surface.vertices[w] - surface.vertices[v]).norm();
        if (longer > distance || longer >= path[w]) continue;
        path[w] = longer;
        next.emplace(longer, w);
      }
    }
    auto &patch = patches[start];
    for (int v : reached) {
      patch.insert(patch.end(), surface.incident_triangles[v].begin(),
                   surface.incident_triangles[v].end());
      path[v] = far;
    }
    reached.clear();
    std::sort(patch.begin(), patch.end());
    patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
  }
  return patches;
}

std::vector<char> fans_that_see(const SurfaceTemplate &surface,
                                const std::vector<std::vector<int>> &patches,
                                const std::vector<TriangleFans::Place> &places)
{
  int fans = 0;
  for (const auto &place : places) fans = std::max(fans, place.fan + 1);
  std::vector<int> sizes(fans, 0), hidden(fans);
  for (const auto &place : places) ++sizes[place.fan];
  std::vector<char> see(std::size_t(fans) * fans, 0);
  for (int v = 0; v < surface.vertex_count(); ++v) {
    std::fill(hidden.begin(), hidden.end(), 0);
    for (int t : patches[v]) ++hidden[places[t].fan];
    for (int t : surface.incident_triangles[v])
      for (int other = 0; other < fans; ++other)
        if (hidden[other] < sizes[other])
          see[std::size_t(places[t].fan) * fans + other] =
              see[std::size_t(other) * fans + places[t].fan] = 1;
  }
  return see;
}

}    // namespace rbc
