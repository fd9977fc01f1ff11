#pragma once

#include <cstdint>
#include <set>
#include <vector>

namespace rbc {

/// A stretch of a vessel through which cells go, that is to be as if it were periodic: each cell
/// that leaves it is to be followed by a copy where it begins. Tells which cells wait for that.
class PeriodicStretch {
 public:
  /// A cell and where its centre is along the stretch.
  struct Cell {
    std::int64_t id;
    double along;
    bool beside;    ///< the centre lies across the stretch, not in it or before or behind it
  };

  /// From 0 to `length`. Copies that are late by more than `patience` are given up.
  PeriodicStretch(double length, double patience) : length_(length), patience_(patience) {}

  /// Whether follow() does the same without this cell.
  bool is_elsewhere(const Cell &cell) const
  {
    return cell.beside || cell.along < 0 || cell.along >= length_ + patience_;
  }

  /// All cells there are, at a later time. Those elsewhere may be left out.
  void follow(const std::vector<Cell> &cells);

  /// IDs of those that wait for a copy, those first that are furthest along.
  const std::vector<std::int64_t> &waiting() const { return waiting_; }
  void copied(std::int64_t id);

  double length() const { return length_; }

  /// What a restart needs.
  std::vector<double> state() const;
  void restore(const std::vector<double> &state);

 private:
  double length_, patience_;
  std::set<std::int64_t> inside_;
  std::vector<std::int64_t> waiting_;
};

}    // namespace rbc
