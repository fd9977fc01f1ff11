#pragma once

#include "geometry/enclosure.h"
#include "packing/rigid_cell.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace rbc {

/// Draws places for rigid cells of one shape, at random in an enclosure, until they fit between
/// what is there. Each draw has a number, and is the same whatever was drawn before.
class CellPlacement {
 public:
  struct Place {
    Vec3 centre;
    Eigen::Matrix3d rotation;
  };

  /// A closed surface of any shape.
  struct Surface {
    std::vector<Vec3> vertices;
    const std::vector<SurfaceTemplate::Corners> *triangles;
  };

  /// Not a number, so that it differs from each row and from itself.
  static constexpr double no_row = std::numeric_limits<double>::quiet_NaN();

  /// Cells keep `gap` from what is there.
  CellPlacement(const SurfaceTemplate &cell, double gap, unsigned seed);

  /// Vertices stay in an enclosure, which lies in that part of space.
  void confine(const Enclosure &enclosure, const Vec3 &lo, const Vec3 &length);

  /// What is there is there again, so far away along each direction; 0: it is not. Call before the
  /// first surface.
  void repeat(const Vec3 &period) { period_ = period; }

  // What is there.

  void clear();
  /// Surfaces of one row are as far from each other as it may be, and do not count for each other.
  void avoid_surface(Surface surface, double row = no_row);
  void avoid_point(const Vec3 &point);

  /// A place at which a cell fits, if one of the next draws is such a place, up to `draws` of them.
  /// A cell placed there is avoided from then on.
  std::optional<Place> find(int draws);

  /// Whether a cell with these vertices, of any shape, is `gap` or more from all that is there but
  /// for surfaces of its row. The enclosure does not count.
  bool fits(std::vector<Vec3> vertices, double gap, double row = no_row) const;

  /// Draws made so far.
  std::int64_t drawn() const { return drawn_; }
  void set_drawn(std::int64_t drawn) { drawn_ = drawn; }

  /// Distance from a centre beyond which nothing is in the way of a cell.
  double reach() const { return shape_.radius + gap_; }

 private:
  struct Placed {
    Surface surface;
    Vec3 centre;
    double radius;    ///< of the sphere about it that holds the surface
    double row;

    explicit Placed(Surface surface, double row = no_row);
  };

  RigidShape shape_;
  double gap_;
  unsigned seed_;
  std::int64_t drawn_ = 0;
  const Enclosure *enclosure_ = nullptr;
  Vec3 lo_ = Vec3::Zero(), length_ = Vec3::Zero(), period_ = Vec3::Zero();
  std::vector<Placed> placed_;
  std::vector<Vec3> points_;

  std::vector<Vec3> images(const Vec3 &centre, double radius) const;
  std::mt19937_64 numbers(std::int64_t draw) const;
  std::optional<RigidCell> draw(std::int64_t number) const;
  bool fits(const RigidCell &cell) const;
  bool is_clear(const RigidCell &cell, const Surface &own, const Surface &other) const;
};

}    // namespace rbc
