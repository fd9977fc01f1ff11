#pragma once

#include "geometry/enclosure.h"
#include "geometry/packing_box.h"

#include <vector>

namespace rbc {

/// Points on the surface of an enclosure, nearly as far apart as those of a lattice of equilateral
/// triangles: some of those in which the lines of a fine grid cross the surface, which then push
/// each other aside along it. The same wherever it is computed.
class SurfaceSampling {
 public:
  /// Looks in the part of the box from lo to hi, which may be all of a periodic direction.
  SurfaceSampling(const Enclosure &enclosure, const PackingBox &box, const Vec3 &lo, const Vec3 &hi,
                  double spacing);

  /// Places that are looked at from lo to hi.
  static double grid_size(const Vec3 &lo, const Vec3 &hi, double spacing);

  const std::vector<Vec3> &points() const { return points_; }

  double area() const { return area_; }

  /// Distances of points to their nearest neighbors.
  double mean_distance() const { return mean_distance_; }
  double least_distance() const { return least_distance_; }

  /// Largest distance of the surface from the nearest point.
  double largest_hole() const { return largest_hole_; }

 private:
  struct Crossing {
    Vec3 place, normal;    ///< the normal points outward
  };

  const Enclosure &enclosure_;
  PackingBox box_;
  Vec3 lo_, hi_;
  double spacing_;
  std::vector<Crossing> crossings_;
  std::vector<Vec3> points_, normals_,
      anchors_;    ///< these are where points were on the surface last
  std::vector<std::vector<std::pair<int, Vec3>>> neighbors_;    ///< numbers and shifts of images
  double area_ = 0, mean_distance_ = 0, least_distance_ = 0, largest_hole_ = 0;

  void find_crossings();
  void add_crossing(Vec3 in, Vec3 out, double tolerance, int direction, double cell_area);
  Vec3 outward(const Vec3 &x, const Vec3 &guess, double tolerance) const;
  void choose();
  void choose(double distance);
  void relax(int steps);
  void find_neighbors();
  void push_apart();
  void project(int n, double tolerance);
  void cut(Vec3 &in, Vec3 &out, double tolerance) const;
  void keep_in_box(Vec3 &x) const;
  bool fill_holes();
  void measure();
};

}    // namespace rbc
