#pragma once

#include "contact/number_lists.h"
#include "contact/packed_distances.h"
#include "contact/relative_motion.h"
#include "geometry/plain_vector.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace rbc {

class SpatialBins;
struct TriangleFeature;

/// A point near a surface and the place of the surface that is closest to it.
struct VertexContact {
  int point;
  std::array<int, 3> corner;       ///< of the triangle closest to the point
  std::array<double, 3> weight;    ///< of the corners at the closest place
  PlainVector normal;    ///< of unit length, outward, along the line from that place to the point
  double gap;            ///< distance, negative inside the surface
};

/// Finds for points the closest point on each closed triangulated surface near them. Surfaces have
/// numbers; a point belongs to one and does not see it, or only some of its triangles. Triangles
/// may be a part of a surface, as long as those that share a corner with one in reach are there.
/// Positions are three numbers for each point, of points and corners in one array.
class NearTriangles {
 public:
  using Surface = std::int32_t;
  static constexpr Surface NO_SURFACE =
      std::numeric_limits<Surface>::min();    ///< a point of it sees nothing

  /// Whether a point sees a triangle of its own surface, which is given by its place in the list
  /// of triangles.
  using SeesOwn = std::function<bool(int point, int triangle)>;

  struct Triangle {
    std::array<int, 3> corner;    ///< right-handed outward
    Surface surface;
  };

  /// Finds what comes within `range` of each other before anything has moved by travel / 2; where
  /// neighbors have come nearer by more than `slack` contacts() finds it anew. `surfaces[n]` is
  /// that of point n < points <= corners; `triangles` have their corners among the `corners` first
  /// positions. Both lists must stay. Without `sees_own` points see nothing of their own surface.
  void build(int points, const Surface *surfaces, int corners, const double *x,
             const std::vector<Triangle> &triangles, double range, double slack, double travel,
             SeesOwn sees_own = {});

  /// The same again for other positions.
  void rebuild(const double *x);

  /// By how much at most a point and a triangle that are in range of each other have come nearer
  /// since that: small where both move with the same flow, even if it shears them. It may move them
  /// by travel / 2.
  double largest_approach(const double *x);

  /// All points nearer than range to a surface: one contact for each such surface. Rebuilds if it
  /// must.
  const std::vector<VertexContact> &contacts(const double *x, double range);

  /// What contacts() returned last.
  const std::vector<VertexContact> &last_contacts() const { return contacts_; }

  std::size_t bytes() const;

 private:
  enum class Side : std::int32_t { unknown, outside, inside };

  /// Triangles of one surface near one point: candidates from `begin` up to those of the next
  /// group.
  struct Group {
    int point, begin;
    float distance;    ///< the least of its candidates
    int nearest;       ///< candidate when last looked for
    Side side;         ///< of the surface on which the point was when built
  };
  /// A group that may be in range, and the square of the distance of its nearest triangle.
  struct Near {
    int group;
    double distance2;
  };
  /// Triangles and their distances when built. Kept small: there are many.
  struct Candidates {
    PackedDistances distance;
    std::vector<int> triangle;

    int count() const { return static_cast<int>(triangle.size()); }
  };
  /// A triangle near the current point.
  struct Found {
    Surface surface;
    float distance;
    int triangle;
  };
  struct Sphere {
    PlainVector centre;
    double radius;
  };
  /// Bounding spheres of triangles, in the order of their bins, with centres from an origin. Single
  /// precision does, as spheres are made larger by what it may be off.
  struct Spheres {
    PlainVector origin;
    double error = 0;    ///< of a distance
    std::vector<float> x, y, z, radius;
    std::vector<Surface> surface;
    std::vector<int> triangle;

    void resize(std::size_t size);
    void set(int n, const Sphere &sphere, Surface surface, int triangle);
  };

  /// Of the surfaces that have spheres in a bin, the lowest and the highest number.
  struct SurfaceRange {
    Surface lowest, highest;

    void add(const SurfaceRange &other);
    bool none_but(Surface surface) const { return lowest >= surface && highest <= surface; }
  };

  double reach_ = 0, slack_ = 0, travel_ = 0;
  int points_ = 0;
  const Surface *surfaces_ = nullptr;    // of points
  const std::vector<Triangle> *triangles_ = nullptr;
  SeesOwn sees_own_;
  NumberLists around_;    // each corner: triangles
  RelativeMotion motion_;
  LinearFlow flow_;      // of all points
  double strain_ = 0;    // norm of the flow for which motion_ was last asked
  int corners_ = 0;
  Spheres spheres_;
  std::vector<SurfaceRange> in_bin_, around_bin_, scratch_;    // around: with the bins next to it
  std::vector<int> bin_begin_, bin_of_, next_, hits_;
  int hit_count_ = 0;
  std::vector<Found> found_;
  std::vector<Group> groups_;
  Candidates candidates_;
  std::vector<Near> near_;                     // some of the groups
  std::vector<std::pair<int, int>> others_;    // of these, and candidates that may be nearer
  std::vector<VertexContact> contacts_;

  static Sphere sphere_around(const double *x, const Triangle &triangle);
  double largest_radius(const double *x) const;
  void hold_flow(const double *x);
  void fit_flow(const double *x);
  double approach_beyond(const double *x, const LinearFlow &flow);

  /// Points move by a flow, A X + c, and by what it leaves of their displacements. How far apart a
  /// point and a place of a triangle were when held, if they are this far apart now and the flow
  /// left this difference:
  ///   |x - y| = |(1 + A) (X - Y) + difference| >= (1 - |A|) |X - Y| - |difference|.
  double held_distance(double distance, double difference) const
  {
    return (distance + difference) / (1 - strain_);
  }

  void sort_spheres(const double *x, const SpatialBins &bins);
  void find_surface_ranges(const SpatialBins &bins);
  void find_hits(const SpatialBins &bins, PlainVector point, Surface unseen, double far);
  bool any_seen(int first_bin, int last_bin, Surface unseen) const;
  template <typename Pair, typename Take>
  void visit_distances(const double *x, int count, const Pair &pair, const Take &take) const;
  void find_candidates(const double *x, int point);
  void add_groups(int point);
  int end_of(int group) const;
  const int *corners(int candidate) const;
  std::size_t find_near_groups(std::size_t g, double range);
  void find_nearest(const double *x, double range);
  void add_contact(const double *x, Group &group);
  bool has_kept_side(const Group &group) const;
  template <typename Function>
  void visit_around(const double *x, const std::array<int, 3> &corner,
                    const TriangleFeature &feature, const Function &f) const;
  bool is_inside(const double *x, const std::array<int, 3> &corner,
                 const std::array<double, 3> &weight, PlainVector face, PlainVector apart) const;
  PlainVector outward(const double *x, const std::array<int, 3> &corner,
                      const std::array<double, 3> &weight, PlainVector face) const;
};

}    // namespace rbc
