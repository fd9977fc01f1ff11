#ifndef LMP_RBC_GAP_SLIP_H
#define LMP_RBC_GAP_SLIP_H

#include "contact/near_triangles.h"
#include "coupling/rbc_atom_rows.h"
#include "fluid/gap_mobility.h"
#include "pointers.h"
#include "support/rbc_step_part.h"

#include <array>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

class CellContact;
class CellMembranes;
class DrivenFlow;

/// Lets surfaces of cells slide past each other, and along plates, as the fluid in the gap between
/// them does, though the gap is narrower than the grid: adds to the velocities of vertices what
/// fluid::GapMobility says is missing.
///
/// A vertex with the tangential traction t (force over its area A) sees a point of another surface,
/// with the traction t' between its corners. The two get the relative velocity s (t - t') / (2
/// viscosity), s what is missing for opposite unit tractions, half of it from the vertices of
/// either side. All together this is  U = M F  with
///   F . M F = sum over vertices of  A s / (8 viscosity) (t - t')^2
/// so that M is symmetric and no force can do work against the fluid. A vertex beside a plate gets
/// s t / viscosity.
class GapSlip : public StepPart, protected Pointers {
 public:
  GapSlip(LAMMPS *lmp, RowExchange &exchange, fluid::KernelKind kernel);

  /// Widest gap for which something is missing, for this spacing of the grid.
  double widest_gap(const DrivenFlow &flow);

  /// At the start of a run. `contact` may be null: then plates alone count.
  void start_run(const DrivenFlow &flow, const std::vector<CellMembranes *> &membranes,
                 const CellContact *contact);

  /// Whether there is anything to do in this scene.
  bool acts() const { return contact_ || plates_[0].holds || plates_[1].holds; }

  void atoms_migrated();

  /// Adds to `velocity` what the forces times `factor` cause, three numbers for each of this rank's
  /// atoms; `members` are those that count. Positions are those of the last evaluation of forces.
  /// Collective.
  void add(const std::vector<int> &members, const double *force, double factor, double *velocity);

  void report_to(const std::shared_ptr<CollectiveStop> & /*stop*/) override {}
  /// Plates alone cost next to nothing.
  std::vector<Section> sections() override
  {
    if (!contact_) return {};
    return {Section{"Gaps", &stopwatch_}};
  }
  std::size_t bytes() const;

 private:
  struct Plate {
    bool holds = false;    ///< fluid that does not slip
    double z = 0;
  };

  RowExchange &exchange_;
  fluid::KernelKind kernel_;
  std::unique_ptr<const fluid::GapMobility> missing_;    ///< made where it is first needed
  const CellContact *contact_ = nullptr;
  std::vector<CellMembranes *> membranes_;
  std::array<Plate, 2> plates_;
  double spacing_ = 1, height_ = 1;    ///< of fluid cells: mean, and along z
  double viscosity_ = 1;
  std::vector<double> area_;    ///< of each vertex of this rank at rest; 0 for other atoms
  AtomRows &traction_;
  AtomRows &slip_;    ///< times area
  rbc::Stopwatch stopwatch_;

  const fluid::GapMobility &missing();
  void set_tractions(const std::vector<int> &members, const double *force, double factor);
  void slide_near_surfaces();
  void slide(const rbc::VertexContact &contact, double missing);
  void slide_along_plates(const std::vector<int> &members, const double *force, double factor,
                          double *velocity) const;
};

}    // namespace LAMMPS_NS

#endif
