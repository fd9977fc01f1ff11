#pragma once

#include "contact/near_triangles.h"
#include "contact/number_lists.h"

#include <vector>

namespace rbc {

/// Parts of surfaces: the triangles around some of the corners, with those in between, which join
/// one of them. Each triangle is in one fan.
class TriangleFans {
 public:
  NumberLists triangles;    ///< of each fan
  NumberLists corners;      ///< of each fan, each once

  /// For corners below `points`.
  void find(const std::vector<NearTriangles::Triangle> &all, int points);

  std::size_t bytes() const;

 private:
  NumberLists around_;             ///< triangles around each corner
  std::vector<int> nearest_;       ///< fan in whose middle or at whose rim a corner is
  std::vector<char> in_middle_;    ///< of its fan
  std::vector<int> fan_of_;        ///< of each triangle
  std::vector<int> next_;

  void choose_middles(const std::vector<NearTriangles::Triangle> &all);
  int fan_of(const std::vector<NearTriangles::Triangle> &all,
             const NearTriangles::Triangle &triangle) const;
  void collect_corners(const std::vector<NearTriangles::Triangle> &all);
};

}    // namespace rbc
