#ifndef LMP_RBC_CELL_MEMBRANES_H
#define LMP_RBC_CELL_MEMBRANES_H

#include "cells/rbc_local_cells.h"
#include "cells/rbc_swelling.h"
#include "membrane/surface_viscosity.h"
#include "membrane/volume_gradient.h"
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
  bool smoothed = false;    ///< tractions, by TractionFilter
  double interior = 0;      ///< viscosity of the fluid inside, 0: that of the fluid outside
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

  /// Between runs: replaces what resists folds and large stretches.
  void limit(const rbc::CreaseResistance &crease, const rbc::StretchLimit &stretch);

  /// Of small deformations, force per length; and the thickness of the cells at rest.
  double shear_modulus() const;
  double thickness();

  const std::string &style() const { return style_; }
  int groupbit() const { return groupbit_; }
  LocalCells &local_cells() { return cells_; }
  const LocalCells &local_cells() const { return cells_; }

  /// Collective, at the start of a run: finds the cells. From here on errors end the run, unless
  /// report_to() is called afterwards.
  void start_run();

  /// Collective, within a run: cells were added or removed.
  void cells_changed() { cells_.identify_again(); }

  /// Collective, after atoms migrated.
  void update_ownership();

  /// Collective, after update_ownership() at the start of a run: warns of cells that look torn.
  void warn_of_torn_cells();

  /// Where changes of area are resisted: call at the end of each step, and warn_of_large_areas(),
  /// which is collective, at that of a run. It warns of an area at which red cells burst.
  void note_areas();
  void warn_of_large_areas();

  /// Distance from an owned vertex within which it needs its neighbors, as edges may be stretched.
  double ghost_reach() const;

  /// Evaluates the factor on the rest volume if it is a variable, once for each step and timestep.
  /// `new_run`: a jump between runs is not a change within a step. Collective.
  void update_swelling(bool new_run);
  Swelling &swelling() { return settings_.swelling; }

  /// Function that receives the virial (xx, yy, zz, xy, xz, yz) of a vertex with its local index.
  /// No virial is computed if it is empty.
  using VirialTally = std::function<void(int vertex, double *virial)>;
  void tally_virial(VirialTally tally) { tally_ = std::move(tally); }

  /// Adds elastic and viscous forces to atom->f of this rank's vertices; ghosts must have
  /// positions. Collective. Flaws of the mesh are reported; without a driver they end the run here.
  void add_forces();

  /// Whether a triangle here was close to a flaw in the last add_forces().
  bool is_nearly_folded() const { return nearly_folded_; }

  /// Elastic energies of all cells in the last add_forces(). Collective.
  rbc::MembraneEnergy energy() const;

  bool is_smoothed() const { return settings_.smoothed; }

  /// Of the fluid inside; 0 where it is that of the fluid outside.
  double interior_viscosity() const { return settings_.interior; }

  /// Whether the fluid inside has another viscosity than this one, that of the fluid outside.
  bool differs_inside(double outside) const
  {
    return settings_.interior > 0 && settings_.interior != outside;
  }

  // viscosity

  bool is_viscous() const { return !settings_.viscosity.is_zero(); }
  bool is_thinning() const { return settings_.viscosity.thins(); }

  /// Adds a multiple of the viscous forces at the atoms' velocities.
  void add_viscous_forces(bool with_virial, double multiple = 1);

  /// Keeps the present velocities: add_viscous_change() linearises the shear-thinning viscosity
  /// there. If `frozen`, its derivative is left out. Does nothing for a constant viscosity.
  /// Collective.
  void linearise(bool frozen);

  /// Adds to atom->f by how much the viscous forces change when the velocities kept by linearise()
  /// change by atom->v. Linear in atom->v. Collective.
  void add_viscous_change();

  /// Power dissipated in all cells. Collective.
  double viscous_power();

  // volume

  bool keeps_volume() const { return settings_.volume_kept; }

  /// Changes the atoms' velocities by a multiple of the volume's gradient such that the volume V of
  /// each cell obeys   sum_i dV/dx_i . v_i = (V_rest - V) / (10 dt) + dV_rest/dt. This changes
  /// neither the velocity of a cell nor its rotation. If `new_step`, the first term is computed
  /// anew; other evaluations of the same step keep it. If `mid_step`, V_rest is that of the middle
  /// of the step. Collective.
  void constrain_volume(double dt, bool new_step, bool mid_step);

  /// The linear part of this: changes the atoms' velocities such that no volume changes.
  void remove_volume_change();

  /// Calls visit(i, dV/dx_i, x_i) for each vertex that is an atom i of this rank, V the volume of
  /// its cell and x_i the position relative to an origin that the cell has on all ranks. dV/dx_i is
  /// a third of the areas around the vertex, times their outward normals. Not collective.
  using GradientVisitor = std::function<void(int, const rbc::Vec3 &, const rbc::Vec3 &)>;
  void visit_volume_gradients(const GradientVisitor &visit);

  /// Calls visit(i, s) for each vertex that is an atom i of this rank, s what
  /// MembraneModel::surface_shear() gives for the atoms' velocities, divided by the area. Ghosts
  /// must have velocities. Not collective.
  using ShearVisitor = std::function<void(int, const rbc::Vec3 &)>;
  void visit_surface_shear(const ShearVisitor &visit);

  void report_to(const std::shared_ptr<CollectiveStop> &stop) override { stop_ = stop; }
  std::vector<Section> sections() override { return {{"Membrane", &stopwatch_}}; }

  double bytes() const;

 private:
  /// Over the vertices i of a cell with volume V.
  struct VolumeSums {
    static constexpr int COUNT = 3;
    double rate = 0;      ///< sum of dV/dx_i . v_i
    double square = 0;    ///< sum of |dV/dx_i|^2
    double volume = 0;

    VolumeSums() = default;
    explicit VolumeSums(const double *numbers) :
        rate(numbers[0]), square(numbers[1]), volume(numbers[2])
    {
    }
    void store(double *numbers) const
    {
      numbers[0] = rate;
      numbers[1] = square;
      numbers[2] = volume;
    }
  };

  std::string style_;
  int groupbit_;
  MembraneSettings settings_;
  rbc::MembraneModel model_;
  rbc::VolumeGradient gradient_of_;
  double thickness_ = -1;    ///< not known yet
  LocalCells cells_;
  std::shared_ptr<CollectiveStop> own_stop_, stop_;
  rbc::Stopwatch stopwatch_;
  VirialTally tally_;

  // of the current cell, an entry for each vertex of the template
  std::vector<rbc::Vec3> x_, f_, v_, gradient_;
  std::vector<double> area_;

  // of all cells here
  std::vector<double> sizes_;    ///< area and volume of each
  struct {
    double value = 0;
    tagint molecule = 0;
  } largest_growth_;    ///< of an area since the start of the run, over that of the template
  std::vector<double> volume_rates_, sums_;
  std::vector<rbc::Vec3> shared_gradient_;    ///< of each vertex of the cells that ranks share
  std::vector<rbc::Vec3> linear_at_;          ///< velocity of each vertex
  bool viscosity_frozen_ = false;
  bool nearly_folded_ = false;
  rbc::MembraneEnergy energy_;    ///< this rank's share

  bool bends() const { return settings_.elastic.bending > 0; }
  void set_current_cell(const LocalCells::Cell &cell);
  void store_size(std::size_t c);
  void measure_shared_cells();
  void check_mesh(const LocalCells::Cell &cell);
  void check_volume(const LocalCells::Cell &cell, double volume);
  void add_elastic_forces(const LocalCells::Cell &cell, const rbc::AreaVolume &size);
  void gather_velocities(const LocalCells::Cell &cell);
  void share_velocities();
  double viscous_forces(const LocalCells::Cell &cell);
  void add_to_atoms(const LocalCells::Cell &cell, bool with_virial);
  template <typename Factor> void add_volume_gradients(const Factor &factor);
  VolumeSums find_volume_gradient(const LocalCells::Cell &cell, rbc::Vec3 *gradient);
  void add_volume_gradient(const LocalCells::Cell &cell, double factor, const rbc::Vec3 *gradient);
  void report(const LocalCells::Cell &cell, const std::string &what, Flaw flaw);
};

/// A fix that owns membranes.
class MembraneOwner {
 public:
  virtual CellMembranes &membranes() = 0;

  /// Between runs: whether atoms have changed since the last one, so that its membranes know their
  /// cells no more. Not collective.
  virtual bool are_atoms_others() const = 0;

 protected:
  ~MembraneOwner() = default;
};

/// The membranes of all fixes rbc/membrane, in the order of their definition.
std::vector<CellMembranes *> all_cell_membranes(LAMMPS *lmp);

}    // namespace LAMMPS_NS

#endif
