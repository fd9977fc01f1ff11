#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace rbc {

/// A stretch of a straight vessel that is as if it were periodic. From where it begins the cells go
/// through a loop. Each cell that comes near to the end of the loop gets a copy, a loop or a little
/// more behind it, which moves as the cell does until it has come to the beginning, or has been let
/// go before. From then on the copy goes by itself. The loop sets how dense the cells are: there
/// are as many in it, whatever its length.
class PeriodicStretch {
 public:
  /// A cell and where its centre is along the stretch.
  struct Cell {
    std::int64_t id;
    double along;
    bool beside;    ///< the centre lies across the stretch, not in it or before or behind it
  };

  /// A copy that is led by a cell, a loop and a shift behind it.
  struct Copy {
    std::int64_t cell, id;
    double shift;
  };

  /// From 0 to `length`. Copies are made up to `lead` before it.
  PeriodicStretch(double length, double lead);

  /// Whether follow() does the same without this cell.
  bool is_elsewhere(const Cell &cell) const;

  /// Cells that should have come past the beginning in a step.
  void pass(double due) { due_ += due; }

  /// All cells there are, at a later time; those elsewhere may be left out. `owed`: how many should
  /// have come past the beginning from the start, and did not. Where cells are owed, or the flux of
  /// those in the loop is low, the loop gets shorter: copies come nearer to their cells. Returns
  /// how many have come past the beginning.
  int follow(const std::vector<Cell> &cells, double owed);

  /// Cells without a copy that should have one, those first that are furthest along.
  const std::vector<Cell> &waiting() const { return waiting_; }

  /// How far behind such a cell's place, a loop before it, its copy may appear: up to so many
  /// shifts, the least one first.
  std::vector<double> shifts(const Cell &cell, int most) const;

  /// Such a cell has a copy now, or shall have none.
  void copied(const Copy &copy);
  void skip(std::int64_t cell);

  /// Those that are led, those first that are furthest along.
  std::vector<Copy> led() const;

  /// The copy of this cell goes by itself from now on.
  void let_go(std::int64_t cell);

  /// Copies, led or let go, that have not yet come past the beginning.
  std::size_t before() const { return copies_.size() + free_.size(); }

  /// Copies to be taken out: with their cells they have gone back from the loop's end.
  const std::vector<std::int64_t> &retired() const { return retired_; }

  /// So many cells have come too much that the next one shall have no copy: the loop cannot get
  /// longer.
  bool is_overfull(double owed) const;

  double loop() const { return loop_; }

  /// What a restart needs.
  std::vector<double> state() const;
  void restore(const std::vector<double> &state);

 private:
  using Places = std::map<std::int64_t, double>;

  double length_, lead_, loop_;
  double due_ = 0;                         ///< since the last call of follow()
  std::int64_t skipped_ = 0;               ///< the last one, while it is in the loop
  Places places_;                          ///< of cells, at the last call of follow()
  std::map<std::int64_t, Copy> copies_;    ///< by cell
  std::set<std::int64_t> free_;            ///< copies before the beginning that were let go
  std::set<std::int64_t> wanted_;          ///< cells that wait
  std::set<std::int64_t> done_;            ///< had a copy, or shall have none
  std::vector<Cell> waiting_;
  std::vector<std::int64_t> retired_;

  void adjust(const Places &now, double owed);
  int release(const Places &now);
  void find_waiting(const Places &now);
};

}    // namespace rbc
