#ifndef LMP_RBC_VISCOSITY_CONTRAST_H
#define LMP_RBC_VISCOSITY_CONTRAST_H

#include "cells/rbc_rigid_motions.h"
#include "fluid/flow.h"
#include "fluid/gap_mobility.h"
#include "pointers.h"
#include "support/rbc_step_part.h"

#include <array>
#include <memory>
#include <vector>

namespace rbc {
struct VertexContact;
}

namespace LAMMPS_NS {

class CellContact;
class CellMembranes;
class DrivenFlow;

/// Cells whose inside has a viscosity of its own. The flow solved for is that of fluid::DoubleLayer
/// in the fluid outside, w = u eta(x) / eta. It needs the velocities of the membranes, so these are
/// the solution of an equation. What a vertex sees of w is u times 1 + e, with e what it sees of a
/// layer that moves with unit velocity: half of eta(x) / eta - 1 inside at a plane surface, another
/// share where surfaces are near each other or curved. The slope of w differs between the two sides
/// of a surface by surface_shear() times eta(x) / eta - 1; what kernels blur of that is taken off.
/// So is, in the part that is relative motion, what a vertex sees of the inside of other cells near
/// it.
///
/// All this counts for the motion of vertices relative to their cell alone. How a cell moves as a
/// whole does not depend on its viscosity, but what the grid makes of the layer of such a motion is
/// wrong by a small part of eta(x) / eta, which may be a large number. So the layer of the relative
/// motion is spread, w is u outside and inside less the rigid motion times eta(x) / eta - 1, and
/// the rest is added for output only. See theory.rst.
class ViscosityContrast : public StepPart, protected Pointers {
 public:
  explicit ViscosityContrast(LAMMPS *lmp) : Pointers(lmp) {}

  /// At the start of a run. Of the membranes those count whose inside has another viscosity.
  /// `contact` tells which surfaces are near each other; it may be null.
  void start_run(DrivenFlow *flow, const std::vector<CellMembranes *> &membranes,
                 fluid::KernelKind kernel, const CellContact *contact);

  /// Whether any do.
  bool acts() const { return !kinds_.empty(); }
  bool acts_on(const CellMembranes &cells) const;

  /// Widest gap across which a vertex sees the inside of another cell.
  double widest_gap(const DrivenFlow &flow, fluid::KernelKind kernel);

  /// Atoms have other numbers here: what is known of them does not hold any more.
  void atoms_migrated() { knows_surfaces_ = false; }
  bool knows_surfaces() const { return knows_surfaces_; }

  /// Finds the surfaces of the cells, where the atoms are now. Collective.
  void find_surfaces();

  /// Finds what vertices see of the viscosity, with these surfaces. Costs a solve. Returns the
  /// first marker whose kernel leaves the ghost layers, or -1. Collective.
  int find_seen(const fluid::MarkerSet &markers);

  /// Finds the viscosity on the grid inside of these surfaces, for output. Collective.
  void find_excess(const fluid::MarkerSet &markers);

  /// The layer of atoms that move with atom->v relative to their cells, and by how much the mean of
  /// w over the box is above that of u. Valid until the next call. Collective.
  struct Moving {
    fluid::DoubleLayer layer;
    std::array<double, 3> mean_excess;
  };
  Moving layer(const fluid::MarkerSet &markers);

  /// To be called in place of layer() where the membranes are taken to be at rest: read() then
  /// expects no layer.
  void leave_out_layer();

  /// Takes off what the markers see of w of the last layer, but should not: `seen` are three
  /// numbers for each of this rank's atoms.
  void take_off_wrong(const fluid::MarkerSet &markers, double *seen) const;

  /// Makes velocities of the markers of what they see of w with the last layer, after
  /// take_off_wrong(), and of what forces add to that beside the grid, the slips. Collective.
  void read(const fluid::MarkerSet &markers, double *velocity);

  /// Adds to the flow the layers of the cells that move as a whole with atom->v: w is then
  /// u eta(x) / eta. Costs a solve. Returns what find_seen() does. Collective.
  int add_rigid_layers(const fluid::MarkerSet &markers);

  void report_to(const std::shared_ptr<CollectiveStop> & /*stop*/) override {}
  std::vector<Section> sections() override { return {{"Contrast", &stopwatch_}}; }
  std::size_t bytes() const;

 private:
  struct Kind {
    CellMembranes *membranes;
    double excess;    ///< viscosity inside over that of the fluid, less 1
  };

  DrivenFlow *flow_ = nullptr;
  std::vector<Kind> kinds_;
  std::vector<RigidMotions> motions_;    ///< of all cells in this fluid
  int in_cells_ = 0;                     ///< groups of their atoms
  const CellContact *contact_ = nullptr;
  std::unique_ptr<const fluid::GapMobility> gaps_;    ///< made where it is first needed

  // of this rank's atoms, zero for those without
  std::vector<double> strength_;    ///< excess times area times outward normal
  std::vector<double> place_;       ///< position within the cell
  std::vector<double> part_;        ///< 1 / (1 + e), e what is seen of the layer of unit velocity
  std::vector<double> wrong_;       ///< what vertices see of w of the last layer, but should not
  std::vector<double> rigid_;       ///< velocities of the cells as wholes, with the last layer
  std::vector<double> relative_;    ///< of the vertices to these, with the last layer
  std::vector<double> left_;        ///< of velocities, by which they differ from those of the layer
  std::vector<double> unit_;        ///< velocities
  std::vector<double> remains_;     ///< of what is seen of other cells, and not taken off
  bool knows_surfaces_ = false;
  rbc::Stopwatch stopwatch_;

  double total_excess() const;
  double excess_of(int i) const;
  void add_blurred(fluid::KernelKind kernel);
  template <typename Visit> void visit_seen(Visit visit) const;
  double across(const rbc::VertexContact &contact, int d) const;
  void add_seen_across();
  void add_wholes_across();
  void find_what_remains();
  void find_rigid(const double *velocity, std::vector<double> &rigid);
  void exchange_with_atoms(std::vector<double> &velocity) const;
  std::array<double, 3> mean_excess(const fluid::MarkerSet &markers, const double *velocity) const;
};

}    // namespace LAMMPS_NS

#endif
