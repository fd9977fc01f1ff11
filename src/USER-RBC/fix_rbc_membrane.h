#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/membrane,FixRBCMembrane);
// clang-format on
#else

#ifndef LMP_FIX_RBC_MEMBRANE_H
#define LMP_FIX_RBC_MEMBRANE_H

#include "cells/rbc_local_cells.h"
#include "cells/rbc_swelling.h"
#include "fix.h"
#include "membrane/surface_viscosity.h"
#include "support/stopwatch.h"

#include <memory>

namespace LAMMPS_NS {

class FixRBCMembrane : public Fix {
 public:
  FixRBCMembrane(class LAMMPS *, int, char **);
  ~FixRBCMembrane() override;
  int setmask() override;
  void init() override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;

  // used by fix rbc/ib: adds a multiple of the viscous forces at the atoms' velocities

  bool is_viscous() const { return !viscosity.is_zero(); }
  void add_viscous_forces(bool with_virial, double multiple = 1);

  // used by fix rbc/ib: adds their change if the velocities at the last linearise() change by those of the atoms, or, if
  // frozen, what it would be at the viscosity that they had

  bool is_thinning() const { return viscosity.thins(); }
  void linearise(bool frozen);
  void add_viscous_change();

  // used by fix rbc/ib: takes from the velocities what would change the cells' volumes

  bool keeps_volume() const { return volume_kept; }
  void keep_volume(double dt, bool new_step, bool mid_step);

  // used by computes and output of whole cells

  const rbc::SurfaceTemplate &shape() const { return *surface; }
  const rbc::MembraneModel &membrane_model() const { return *model; }
  LocalCells &local_cells() { return *cells; }

  // used by fix rbc/ib: which checks for errors from then on, in this run

  void report_to(const std::shared_ptr<CollectiveStop> &driver) { stop = driver; }

  rbc::Stopwatch stopwatch;

 private:
  std::shared_ptr<CollectiveStop> stop, own_stop;
  std::unique_ptr<rbc::SurfaceTemplate> surface;
  std::unique_ptr<rbc::MembraneModel> model;
  std::unique_ptr<LocalCells> cells;
  bool volume_kept = true;
  rbc::SurfaceViscosity viscosity;
  Swelling swelling;
  double ghost_cutoff = 0;    // that this fix asked for

  std::vector<rbc::Vec3> x, f, v;
  std::vector<rbc::Vec3> linear_at;    // velocities of the vertices of all cells here
  bool viscosity_frozen = false;
  std::vector<rbc::Vec3> volume_gradient;    // of the vertices of all cells here, see keep_volume()
  std::vector<double> sizes;                 // area and volume of each cell here
  std::vector<double> volume_rates, sums;
  rbc::MembraneEnergy energy, energy_all;
  bigint energy_step = -1;

  rbc::MembraneParameters parse(int, char **);
  double reach() const;
  void update_swelling(bool new_run);
  void gather_velocities(const LocalCells::Cell &);
  double viscous_forces(const LocalCells::Cell &);
  double viscous_power();
  void add_to_atoms(const LocalCells::Cell &, bool with_virial);
  void take(const LocalCells::Cell &);
  void store_size(std::size_t);
  void measure_shared_cells();
  void check(const LocalCells::Cell &, double volume);
  void add_forces(const LocalCells::Cell &, const rbc::CellSize &);
  void report(const LocalCells::Cell &, const std::string &);
  const rbc::MembraneEnergy &total_energy();
};

}    // namespace LAMMPS_NS

#endif
#endif
