#ifndef LMP_RBC_CELL_MEMBRANES_H
#define LMP_RBC_CELL_MEMBRANES_H

#include "cells/rbc_local_cells.h"
#include "cells/rbc_swelling.h"
#include "membrane/surface_viscosity.h"
#include "support/rbc_step_part.h"

#include <functional>
#include <memory>

namespace LAMMPS_NS {

/// What the cells of one fix rbc/membrane are made of.
struct MembraneSettings {
  std::unique_ptr<rbc::SurfaceTemplate> surface;
  rbc::MembraneParameters elastic;
  rbc::SurfaceViscosity viscosity;
  Swelling swelling;
  bool volume_kept = true;
};

/// The membranes of one fix rbc/membrane: forces, viscosity and volume of those parts of its cells
/// that this rank holds. Positions, velocities and forces are those of LAMMPS's atoms.
class CellMembranes : public StepPart, protected Pointers {
 public:
  /// `style` names the fix in errors.
  CellMembranes(LAMMPS *lmp, std::string style, int groupbit, MembraneSettings settings);
  ~CellMembranes() override = default;

  const rbc::SurfaceTemplate &shape() const { return *settings_.surface; }
  const rbc::MembraneParameters &parameters() const { return settings_.elastic; }
  const std::string &style() const { return style_; }
  int groupbit() const { return groupbit_; }
  LocalCells &local_cells() { return cells_; }
  const LocalCells &local_cells() const { return cells_; }

  /// Collective, at the start of a run: finds the cells. Errors end the run unless a driver asks
  /// for them.
  void start_run();

  /// Collective, after atoms migrated.
  void update_ownership();

  /// Collective, after update_ownership() at the start of a run: warns of cells that look torn.
  void warn_of_torn_cells();

  /// Distance from an owned vertex within which it needs its neighbors, as edges may be stretched.
  double ghost_reach() const;

  /// A variable factor on the rest volume. Collective.
  void update_swelling(bool new_run);
  Swelling &swelling() { return settings_.swelling; }

  /// Takes each vertex' share of the virial; empty where no virial is asked for.
  using VirialTally = std::function<void(int vertex, double *virial)>;
  void tally_virial(VirialTally tally) { tally_ = std::move(tally); }

  /// Adds elastic and viscous forces to the atoms.
  void add_forces();

  /// Elastic energies of all cells in the last add_forces(). Collective.
  rbc::MembraneEnergy energy() const;

  // viscosity

  bool is_viscous() const { return !settings_.viscosity.is_zero(); }
  bool is_thinning() const { return settings_.viscosity.thins(); }

  /// Adds a multiple of the viscous forces at the atoms' velocities.
  void add_viscous_forces(bool with_virial, double multiple = 1);

  /// Keeps the velocities at which the viscosity that thins is linearised. If `frozen` it stays
  /// what it is there.
  void linearise(bool frozen);

  /// Adds the change of the viscous forces if the velocities of linearise() change by those of the
  /// atoms.
  void add_viscous_change();

  /// Power dissipated in all cells. Collective.
  double viscous_power();

  // volume

  bool keeps_volume() const { return settings_.volume_kept; }

  /// Takes from the atoms' velocities what would change the volumes of their cells:
  ///   sum_i dV/dx_i . v_i = (V_rest - V) / (10 dt) + dV_rest/dt,
  /// by a multiple of the volume's gradient, which changes neither a cell's velocity nor its
  /// rotation. An evaluation at the start of a step (`new_step`) sets the first rate, which the
  /// stages after it keep. In the middle of a step (`mid_step`) the rest volume is that of the
  /// middle. Collective.
  void constrain_volume(double dt, bool new_step, bool mid_step);

  void report_to(const std::shared_ptr<CollectiveStop> &driver) override { stop_ = driver; }
  std::vector<Section> sections() override { return {{"Membrane", &stopwatch_}}; }

  double bytes() const;

 private:
  std::string style_;
  int groupbit_;
  MembraneSettings settings_;
  rbc::MembraneModel model_;
  LocalCells cells_;
  std::shared_ptr<CollectiveStop> own_stop_, stop_;
  rbc::Stopwatch stopwatch_;
  VirialTally tally_;

  // of the current cell, an entry for each vertex of the template
  std::vector<rbc::Vec3> x_, f_, v_;

  // of all cells here
  std::vector<double> sizes_;    ///< area and volume of each
  std::vector<double> volume_rates_, sums_;
  std::vector<rbc::Vec3> volume_gradient_;    ///< of each vertex
  std::vector<rbc::Vec3> linear_at_;          ///< velocity of each vertex
  bool viscosity_frozen_ = false;
  rbc::MembraneEnergy energy_;    ///< this rank's share

  bool bends() const { return settings_.elastic.bending > 0; }
  void set_current_cell(const LocalCells::Cell &cell);
  void store_size(std::size_t c);
  void measure_shared_cells();
  void check(const LocalCells::Cell &cell, double volume);
  void add_elastic_forces(const LocalCells::Cell &cell, const rbc::AreaVolume &size);
  void gather_velocities(const LocalCells::Cell &cell);
  void share_velocities();
  double viscous_forces(const LocalCells::Cell &cell);
  void add_to_atoms(const LocalCells::Cell &cell, bool with_virial);
  void find_volume_sums();
  void report(const LocalCells::Cell &cell, const std::string &what);
};

/// A fix that owns membranes.
class MembraneOwner {
 public:
  virtual CellMembranes &membranes() = 0;

 protected:
  ~MembraneOwner() = default;
};

/// Of all fixes, in the order in which they are defined.
std::vector<CellMembranes *> all_cell_membranes(LAMMPS *lmp);

}    // namespace LAMMPS_NS

#endif
