#ifndef LMP_RBC_CELL_CHANGES_H
#define LMP_RBC_CELL_CHANGES_H

namespace LAMMPS_NS {

class LAMMPS;

/// A fix that adds cells to a group within a run, and removes them.
class CellSource {
 public:
  virtual int fed_groupbit() const = 0;

 protected:
  ~CellSource() = default;
};

/// Whether a fix adds cells to a group, which may be empty then.
bool is_fed(LAMMPS *lmp, int groupbit);

/// A fix, pair style or compute that knows which cells there are.
class CellWatcher {
 public:
  /// Cells have been added or removed within a run, before atoms migrate, and the membranes know of
  /// it. Collective.
  virtual void cells_changed() = 0;

 protected:
  ~CellWatcher() = default;
};

/// Tells all watchers: the membranes and other fixes, pair styles, then computes. Collective.
void tell_of_changed_cells(LAMMPS *lmp);

}    // namespace LAMMPS_NS

#endif
