#pragma once

#include "contact/near_fans.h"
#include "contact/neighbor_motion.h"
#include "contact/surface_crossing.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace rbc {

/// Finds whether triangulated surfaces pass through each other in a step in which their corners
/// move along straight lines. Pairs of fans of triangles that can come near are listed, each with a
/// line along which the two are apart, and where there is none the pairs of their triangles. What
/// is apart along a line at both ends of a step cannot have touched within it, so that few need
/// more. Positions are three numbers for each point.
class CrossingFinder {
 public:
  CrossingFinder() = default;
  CrossingFinder(const CrossingFinder &) = delete;    // parts of it point to each other
  CrossingFinder &operator=(const CrossingFinder &) = delete;

  using Triangle = NearTriangles::Triangle;
  using Surface = NearTriangles::Surface;

  /// Two triangles, by their places in the list of triangles.
  struct Pair {
    int first, second;
  };

  /// What to test.
  struct Scene {
    const std::vector<Triangle> *triangles = nullptr;    ///< must stay
    int points = 0;               ///< have positions; the corners are among them
    int owned = 0;                ///< the first points; pairs without one are left to other ranks
    double margin = 0;            ///< distance within which pairs are listed
    double furthest = 0;          ///< the largest distance within which pairs need ever be listed
    bool own_surfaces = false;    ///< surfaces cross themselves, too
    std::function<bool(Pair)> tested;    ///< whether a pair is, the same for all of two surfaces

    // What is known before, if it is: the place of each triangle among the fans of its surface,
    // which must stay, and whether any triangles of two fans of one surface are tested, each fan
    // given by one of its triangles.
    const std::vector<TriangleFans::Place> *places = nullptr;
    std::function<bool(Pair)> fans_tested{};
  };

  /// All begins anew with a scene, or with another answer of `tested`.
  void build(Scene scene);

  /// The positions from which a step leads on. It may be tried several times.
  void start(const double *x);

  /// Two triangles that touched on the way to `x`, if there are any. `known` is false, and none are
  /// given, where points move by more than Scene::furthest relative to their neighbors, as
  /// NeighborMotion measures it: less the flow that moves all of them, by the diagonals of boxes.
  struct Outcome {
    bool known;
    std::optional<Pair> crossed;
  };
  Outcome find(const double *x);

  /// All that touch or intersect at `x`.
  std::vector<Pair> crossed(const double *x);

  /// How many steps were tested, and how often pairs were listed anew for it.
  struct Counts {
    std::int64_t steps = 0, lists = 0;
  };
  const Counts &counts() const { return counts_; }

  std::size_t bytes() const;

 private:
  /// A direction in whole parts of UNIT, rounded toward zero: of unit length or a little less, so
  /// that what is apart along it by some distance is apart by at least that.
  struct Line {
    static constexpr int UNIT = std::numeric_limits<std::int16_t>::max();
    std::int16_t x, y, z;

    operator PlainVector() const
    {
      constexpr double part = 1.0 / UNIT;
      return {part * x, part * y, part * z};
    }
    Line operator-() const
    {
      const auto minus = [](std::int16_t s) { return static_cast<std::int16_t>(-s); };
      return {minus(x), minus(y), minus(z)};
    }
  };

  /// Two fans or two triangles, and a line along which the first is beyond the second. Kept small:
  /// there are many.
  struct Listed {
    Pair pair;
    float gap;    ///< along the line when listed, or a little less
    Line line;
    bool fans;
    bool apart;    ///< along the line at the start of the step
  };

  /// Around a triangle.
  struct Sphere {
    PlainVector centre;
    double radius;
    int triangle;
  };

  /// The normal of a fan, and where its corners were along it when listed.
  struct Normal {
    Line line;
    Bounds along;
  };

  /// The corners of a fan or a triangle.
  struct Corners {
    const int *first, *last;
    const int *begin() const { return first; }
    const int *end() const { return last; }
  };

  Scene scene_;
  NearFans near_;

  bool current_ = false;    ///< what is listed holds at the start of the step
  std::vector<double> start_;
  std::uint64_t end_ = 0;     ///< digest of where the last step that was tested led
  double reach_ = 0;          ///< distance within which pairs are listed
  double needed_ = 0;         ///< for the last step that was tested
  double since_build_ = 0;    ///< for the steps since the build for which earlier lists held
  double foreseen_ = 0;       ///< for those from a build to the next
  double radius_ = 0;         ///< of the largest fan when listed
  NeighborMotion motion_;
  std::vector<Listed> listed_;

  std::vector<Sphere> spheres_;    ///< of a fan
  std::vector<Normal> normal_;     ///< of each fan near owned ones
  Counts counts_;

  void list(const double *x, double reach);
  void find_needed_reach(const double *x);
  void find_normals(const double *x);
  void try_fan_lines(Listed &listed) const;
  void consider_fans(const double *x, Pair fans);
  static Sphere sphere_around(const double *x, const Triangle &triangle);
  void find_spheres(const double *x, int fan);
  Pair fans_of(const Listed &listed) const;
  void split(const double *x, Pair fans, double reach);
  void consider(const double *x, Pair pair, double reach);
  static Line unit(PlainVector v);
  static void keep_line(Listed &listed, Line line, Bounds first, Bounds second);
  void try_line(Listed &listed, const double *x, Line line) const;
  bool stay_apart(const Listed &listed, const double *x);
  bool triangles_touched(Listed &listed, const double *x);
  Corners corners(int body, bool fan) const;
  static bool is_here(bool first_owned, bool second_owned, Surface first, Surface second);
  bool is_owned(int triangle) const;
};

}    // namespace rbc
