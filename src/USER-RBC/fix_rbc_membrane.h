#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/membrane,FixRBCMembrane);
// clang-format on
#else

#ifndef LMP_FIX_RBC_MEMBRANE_H
#define LMP_FIX_RBC_MEMBRANE_H

#include "cells/rbc_atom_mark.h"
#include "cells/rbc_cell_changes.h"
#include "cells/rbc_cell_membranes.h"
#include "fix.h"
#include "support/rbc_arguments.h"
#include "support/rbc_ghost_cutoff.h"

namespace LAMMPS_NS {

/// Elastic and viscous forces of cells' membranes: arguments, checks, output and LAMMPS's hooks.
class FixRBCMembrane : public Fix, public MembraneOwner, public CellWatcher {
 public:
  FixRBCMembrane(class LAMMPS *, int, char **);
  int setmask() override;
  int modify_param(int, char **) override;
  void init() override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void setup(int) override;
  void post_force(int) override;
  void end_of_step() override;
  void post_run() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  CellMembranes &membranes() override { return cells; }
  bool are_atoms_others() const override { return end_of_run.is_old(); }
  void cells_changed() override { cells.cells_changed(); }

 private:
  GhostCutoff ghosts;
  CellMembranes cells;
  AtomMark end_of_run;
  rbc::MembraneEnergy energy;    // of all ranks
  bigint energy_step = -1;

  MembraneSettings parse(int, char **);
  void check_settings(const MembraneSettings &) const;
  void check_crease(const rbc::MembraneParameters &) const;
  rbc::SheetLaw read_law(Arguments &);
  void read_bending(Arguments &, rbc::MembraneParameters &);
  /// Keywords of what keeps a mesh usable, which fix_modify knows, too.
  static std::vector<Arguments::Keyword> limits(Arguments &, rbc::MembraneParameters &);
  void read_volume(Arguments &, MembraneSettings &);
  rbc::SurfaceViscosity read_viscosity(Arguments &);
  void check_apart() const;
  void ask_for_ghosts();
  void keep_cells_together();
  const rbc::MembraneEnergy &total_energy();
};

}    // namespace LAMMPS_NS

#endif
#endif
