#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/vtk,FixRBCVTK);
// clang-format on
#else

#ifndef LMP_FIX_RBC_VTK_H
#define LMP_FIX_RBC_VTK_H

#include "cells/rbc_cell_changes.h"
#include "cells/rbc_cell_membranes.h"
#include "fix.h"

#include <string>
#include <vector>

namespace rbc {
class VtpWriter;
}

namespace LAMMPS_NS {

class FixRBCVTK : public Fix, public RunEnd, public CellWatcher {
 public:
  FixRBCVTK(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void cells_changed() override;
  void setup(int) override;
  void end_of_step() override;
  void write_failure(const std::string &) override;

 private:
  struct Vertex;
  struct Writers;

  std::string file;
  bool pieces;    // a file for each rank
  bool unwrap = false;
  std::string aggregate_id;    // of the compute whose aggregates are written, empty for none
  class ComputeRBCAggregate *aggregate = nullptr;
  std::vector<CellMembranes *> sources;
  bigint last_step = -1;

  void check_whole(const CellMembranes &) const;
  void write(class ComputeRBCAggregate *, const std::string & = "");
  Writers find_writers(CellMembranes &) const;
  std::vector<Vertex> collect(const CellMembranes &, const Writers &);
  void write_cells(const CellMembranes &, int, const Writers &, const ComputeRBCAggregate *,
                   rbc::VtpWriter *);
  void wrap(std::vector<rbc::Vec3> &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
