#pragma once

#include "contact/near_triangles.h"
#include "contact/number_lists.h"
#include "geometry/vector_loop.h"

#include <vector>

namespace rbc {

/// Parts of surfaces: the triangles around some of the corners, with those in between, which join
/// one of them. Each triangle is in one fan.
class TriangleFans {
 public:
  /// Where a triangle of a surface is among its fans, which are the same for all copies of it. A
  /// fan of a copy is known by the corner in its middle, and that by corners at the rim that have
  /// no other fan.
  struct Place {
    unsigned fan : 26;         ///< of the surface
    unsigned known : 2;        ///< the corner by which the fan of a copy is known
    unsigned by_middle : 1;    ///< it is in the middle of the fan, not at its rim
    unsigned rim : 3;          ///< a bit for each corner at the rim that has no other fan
  };

  NumberLists triangles;    ///< of each fan
  NumberLists corners;      ///< of each fan, some of them again: whole groups of GROUP

  /// For corners below `points`.
  void find(const std::vector<NearTriangles::Triangle> &all, int points);

  /// What join() takes of each triangle of a surface for which find() was called.
  std::vector<Place> places(const std::vector<NearTriangles::Triangle> &all) const;

  /// The same as find(), for copies of surfaces of which the places are known, or parts of them.
  void join(const std::vector<NearTriangles::Triangle> &all, const std::vector<Place> &places,
            int points);

  /// In which a triangle is.
  int fan(int triangle) const { return fan_of_[triangle]; }

  std::size_t bytes() const;

 private:
  NumberLists around_;             ///< triangles around each corner
  std::vector<int> nearest_;       ///< a fan in whose middle or at whose rim a corner is
  std::vector<char> in_middle_;    ///< of its fan
  std::vector<int> fan_of_;        ///< of each triangle
  std::vector<int> next_;

  void choose_middles(const std::vector<NearTriangles::Triangle> &all);
  int fan_of(const std::vector<NearTriangles::Triangle> &all,
             const NearTriangles::Triangle &triangle) const;
  void collect(const std::vector<NearTriangles::Triangle> &all, int fans);
  void collect_corners(const std::vector<NearTriangles::Triangle> &all, std::vector<int> &last_fan);
};

}    // namespace rbc
