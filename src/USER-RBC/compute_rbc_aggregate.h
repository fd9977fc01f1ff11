#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(rbc/aggregate,ComputeRBCAggregate);
// clang-format on
#else

#ifndef LMP_COMPUTE_RBC_AGGREGATE_H
#define LMP_COMPUTE_RBC_AGGREGATE_H

#include "cells/rbc_cell_changes.h"
#include "cells/rbc_group_cells.h"
#include "cells/rbc_near_surfaces.h"
#include "compute.h"
#include "contact/aggregate_sizes.h"
#include "contact/touching_cells.h"
#include "support/rbc_row_lock.h"

#include <optional>
#include <vector>

namespace LAMMPS_NS {

class ComputeRBCAggregate : public Compute, public CellWatcher {
 public:
  ComputeRBCAggregate(class LAMMPS *, int, char **);
  ~ComputeRBCAggregate() override;
  void init() override;
  void cells_changed() override;
  void setup() override;
  void compute_vector() override;
  void compute_array() override;
  void compute_peratom() override;
  int lock_length() override { return size_array_rows; }
  void lock(class Fix *fix, bigint, bigint last) override { rows_lock.lock(fix, last); }
  void unlock(Fix *fix) override { rows_lock.unlock(fix); }
  double memory_usage() override;

 private:
  struct Surface {
    std::vector<double> share;    // of the area of its cell, for each atom here
    std::vector<char> split;      // cells of which other ranks have a part
  };

  double gap;
  double least_share = 0;    // of a cell's area that lies within the gap, 0 for any vertex
  GroupCells cells;
  std::optional<NearSurfaces> near;    // where no pair style sees as far
  RowLock rows_lock;
  rbc::DisjointSets sets{0};
  rbc::AggregateSizes sizes;
  bigint found_step = -1;
  int nmax = 0;

  void set_rows();
  void find_aggregates();
  const class CellContact *find_seeing() const;
  void look_for_itself();
  const std::vector<rbc::VertexContact> &contacts();
  std::vector<rbc::TouchedShare> touched_here();
  Surface surface_here() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
