#ifndef LMP_RBC_CELL_CROSSINGS_H
#define LMP_RBC_CELL_CROSSINGS_H

#include "contact/crossing_finder.h"
#include "lmptype.h"
#include "pointers.h"
#include "support/rbc_collective_stop.h"
#include "support/stopwatch.h"

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class CellContact;
class NearSurfaces;

/// Whether surfaces of cells pass through each other in a step. Vertices move along straight lines
/// from their positions at its start to those at its end.
class CellCrossings : protected Pointers {
 public:
  /// `style` names the pair style in messages. Cells of two atom types are tested if they `touch`.
  CellCrossings(LAMMPS *lmp, std::string style, const NearSurfaces &surfaces,
                std::function<bool(int itype, int jtype)> touch);

  /// At the start of a run, after `surfaces` were built: cells that cross already are left out in
  /// this run, with a warning. What styles `before` this one, `style`, test is left to them.
  /// Returns whether there is anything else. Collective.
  bool start_run(const CellContact &style, std::vector<const CellContact *> before);

  /// The atoms, ghosts too, are where the step starts. Not collective.
  void start_step();

  /// Reports to `stop`, which must be checked later, two cells that have crossed on the way to
  /// where this rank's atoms are now. Collective: ghosts get their positions.
  void report(CollectiveStop &stop);

  /// A step is taken again because of such a report, of this or another pair style.
  void count_retaken() { ++retaken_; }

  /// At the end of a run: says how many steps were taken again, if any were. Once: fix rbc/ib may
  /// be gone in the next run.
  void tell();

  rbc::Stopwatch &stopwatch() { return stopwatch_; }
  double bytes() const { return static_cast<double>(finder_.bytes()); }

 private:
  using Pair = rbc::CrossingFinder::Pair;
  using Cells = std::pair<tagint, tagint>;    ///< molecule IDs, the lower one first

  std::string style_;
  const NearSurfaces &surfaces_;
  std::function<bool(int, int)> touch_;
  rbc::CrossingFinder finder_;
  bigint build_ = -1;    ///< of the surfaces, from which the finder knows its triangles
  std::vector<const CellContact *> before_;
  double own_gap_ = 0;
  std::set<Cells> left_out_;    ///< as they crossed at the start of the run
  bigint retaken_ = 0;
  rbc::Stopwatch stopwatch_;

  void learn_triangles();
  void report_found(CollectiveStop &stop);
  bool is_tested(Pair pair) const;
  bool tests_types(int itype, int jtype) const;
  bool tests_itself(int itype) const;
  bool tests_anything() const;
  Cells cells(Pair pair) const;
};

}    // namespace LAMMPS_NS

#endif
