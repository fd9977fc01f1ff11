#include "geometry/joined_vertices.h"

#include <algorithm>
#include <cmath>

namespace rbc {

Vec3 JoinedVertices::nearest_shift(const Vec3 &from, const Vec3 &to) const
{
  Vec3 shift = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (periods_[d] > 0) shift[d] = std::round((to[d] - from[d]) / periods_[d]) * periods_[d];
  return shift;
}

void JoinedVertices::join(const Cell &cell)
{
  open_.clear();
  for (int v = 0; v < shape_->vertex_count(); ++v)
    if (cell.placed[v]) open_.push_back(v);
  // the queue grows while it is read: first in, first out
  for (std::size_t next = 0; next < open_.size(); ++next) {
    const int v = open_[next];
    for (int w : shape_->neighbors[v]) {
      if (cell.placed[w] || !cell.known[w]) continue;
      cell.shift[w] = nearest_shift(cell.x[w], cell.x[v] + cell.shift[v]);
      cell.placed[w] = 1;
      open_.push_back(w);
    }
  }
}

JoinedVertices::Edge JoinedVertices::widest(const Cell &cell) const
{
  Edge worst;
  for (const Hinge &hinge : shape_->hinges) {
    if (!cell.known[hinge.a] || !cell.known[hinge.b]) continue;
    const Vec3 edge = cell.x[hinge.b] + cell.shift[hinge.b] - cell.x[hinge.a] - cell.shift[hinge.a];
    for (int d = 0; d < 3; ++d) {
      const double ratio = periods_[d] > 0 ? 2 * std::abs(edge[d]) / periods_[d] : 0;
      if (ratio > worst.ratio) worst = {hinge.a, hinge.b, ratio};
    }
  }
  return worst;
}

JoinedVertices::Edge JoinedVertices::most_stretched(const Cell &cell) const
{
  Edge worst;
  for (const Hinge &hinge : shape_->hinges) {
    if (!cell.known[hinge.a] || !cell.known[hinge.b]) continue;
    const Vec3 edge = cell.x[hinge.b] + cell.shift[hinge.b] - cell.x[hinge.a] - cell.shift[hinge.a];
    const Vec3 rest = shape_->vertices[hinge.b] - shape_->vertices[hinge.a];
    const double ratio = edge.norm() / rest.norm();
    if (ratio > worst.ratio) worst = {hinge.a, hinge.b, ratio};
  }
  return worst;
}

}    // namespace rbc
