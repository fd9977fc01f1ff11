#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(rbc/cell,ComputeRBCCell);
// clang-format on
#else

#ifndef LMP_COMPUTE_RBC_CELL_H
#define LMP_COMPUTE_RBC_CELL_H

#include "cells/rbc_cell_changes.h"
#include "cells/rbc_group_cells.h"
#include "compute.h"
#include "support/rbc_row_lock.h"

#include <vector>

namespace LAMMPS_NS {

class ComputeRBCCell : public Compute, public CellWatcher {
 public:
  ComputeRBCCell(class LAMMPS *, int, char **);
  ~ComputeRBCCell() override;
  void init() override;
  void cells_changed() override;
  void compute_array() override;
  int lock_length() override { return size_array_rows; }
  void lock(class Fix *fix, bigint, bigint last) override { rows_lock.lock(fix, last); }
  void unlock(Fix *fix) override { rows_lock.unlock(fix); }
  double memory_usage() override;

 private:
  GroupCells cells;    // one for each row
  RowLock rows_lock;
  std::vector<double> sums;
  bool warned = false;    // of a centre that jumped

  void set_rows(const std::vector<tagint> &before);
  void add_sums(CellMembranes &);
  void warn_of_jump(const double *row, const rbc::Vec3 &centre);
};

}    // namespace LAMMPS_NS

#endif
#endif
