#pragma once

#include "geometry/enclosure.h"
#include "geometry/packing_box.h"
#include "packing/cell_approach.h"
#include "packing/rigid_cell.h"

#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace rbc {

/// Tasks that share work and all get the result.
struct Ranks {
  int me = 0, count = 1;

  /// The numbers of all ranks, in their order.
  std::function<std::vector<double>(const std::vector<double> &)> gather =
      [](const std::vector<double> &mine) { return mine; };
};

/// Packs rigid cells at random, without overlap: small ones at random places and in random
/// directions grow, and push each other aside where they touch. All ranks know all places; each
/// finds its share of the forces, and these are summed in one order, so that the result does not
/// depend on the number of ranks.
class CellPacking {
 public:
  /// Cells of `kinds`, which number the templates.
  CellPacking(const PackingBox &box, const std::vector<const SurfaceTemplate *> &templates,
              std::vector<int> kinds, double gap, unsigned seed, Ranks ranks = {});

  /// Vertices stay in an enclosure, which lies in that part of the box.
  void confine(const Enclosure &enclosure, const Vec3 &lo, const Vec3 &length);

  /// Cells keep the gap from points, too.
  void avoid(std::vector<Vec3> points);

  /// Packs in that many steps at most. If it fails, cells are left that have shrunk until they fit.
  bool pack(int steps);

  const std::vector<RigidCell> &cells() const { return cells_; }

  /// Size of the cells over that of their templates.
  double size() const { return size_; }

  /// Between surfaces, up to a little more than what was asked for.
  double least_gap() const { return least_gap_; }

  int steps_taken() const { return steps_taken_; }

 private:
  struct Pair {
    int a, b;
    Vec3 image;    ///< shift of b
  };
  struct Contact {
    int pair;
    CellApproach a_to_b, b_to_a;
  };
  struct Single {
    int cell;
    std::vector<Vec3> points;
  };

  PackingBox box_;
  std::vector<std::unique_ptr<RigidShape>> shapes_;
  std::vector<int> kinds_;
  double gap_;
  Ranks ranks_;
  std::mt19937_64 random_;
  const Enclosure *enclosure_ = nullptr;
  Vec3 part_lo_, part_length_;
  std::vector<Vec3> points_;

  std::vector<RigidCell> cells_;
  std::vector<Eigen::Quaterniond> rotations_;
  std::vector<Vec3> anchors_;    ///< last centre of each that was inside the enclosure
  double size_ = 0, radius_ = 0, growing_overlap_ = 0;
  double margin_ = 0;    ///< kept beyond the gap, for the errors of the distance fields
  double least_gap_ = 0;
  int steps_taken_ = 0;

  std::vector<Pair> pairs_;
  std::vector<Contact> contacts_;    ///< of this rank's share of the pairs
  std::vector<Single> singles_;      ///< this rank's share of the cells, and the points near each
  std::vector<double> moved_;        ///< of any vertex of a cell since these were found
  double grown_ = 0;

  double uniform(double lo, double hi);
  bool place();
  bool place_spheres();
  bool in_part(const Vec3 &x) const;
  void find_neighbors();
  bool neighbors_are_old() const;
  std::vector<Wrench> pushes();
  void push_from_walls(const Vec3 &arm, const Vec3 &x, Wrench &push) const;
  Wrench outer_push(const Single &single) const;
  void move(const std::vector<double> &moves);
  void resize(double size);
  bool settle(int steps, bool growing);
  bool check();
  double clearance() const { return gap_ + margin_; }
  double reach() const;
  RigidCell shifted(const Pair &pair) const;
  std::pair<int, int> share(std::size_t count) const;
};

}    // namespace rbc
