#pragma once

#include "packing/rigid_cell.h"

#include <vector>

namespace rbc {

/// Vertices and edges of one cell, the probe, in the distance field of another of the same size,
/// the body.
class CellApproach {
 public:
  /// Those that are nearer than `reach`, lengths in those of the template.
  CellApproach(const RigidCell &probe, const RigidCell &body, double reach);

  bool empty() const { return vertices_.empty(); }

  /// On the probe: down the energy (clearance - distance)^2 / 2, summed over the vertices, and the
  /// points of edges closest to the body, that are nearer than `clearance`. The body is pushed the
  /// other way at the same places.
  void push(const RigidCell &probe, const RigidCell &body, double clearance, Wrench &push) const;

 private:
  struct Edge {
    int a, b;
  };

  std::vector<int> vertices_;
  std::vector<Edge> edges_;    ///< between places in vertices_
};

}    // namespace rbc
