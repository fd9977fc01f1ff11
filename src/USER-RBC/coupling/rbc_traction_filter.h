#ifndef LMP_RBC_TRACTION_FILTER_H
#define LMP_RBC_TRACTION_FILTER_H

#include "cells/rbc_local_cells.h"
#include "coupling/rbc_atom_rows.h"
#include "geometry/surface_filter.h"
#include "pointers.h"
#include "support/rbc_step_part.h"

#include <vector>

namespace LAMMPS_NS {

class CellMembranes;
class DrivenFlow;

/// Smooths the tractions t (force over area) of membranes, and the velocities with which they move:
///   U = P u[P t] + SLIP dx / viscosity (1 - P)^2 t
/// where u[t] are the velocities that the grid gives vertices with these tractions, and P is a
/// SurfaceFilter. U is symmetric in t, and no force can do work against the fluid.
///
/// What resists a change of its shape asks for velocities that mesh and grid give only with
/// tractions that are rough. The grid hardly moves vertices for these, so they become large, and
/// through the little that they do to the smooth velocities they change how the body moves, as if
/// it were larger or smaller by a part of dx. See theory.rst.
class TractionFilter : public StepPart, protected Pointers {
 public:
  TractionFilter(LAMMPS *lmp, RowExchange &exchange);

  /// At the start of a run. Of the membranes those count that ask for it.
  void start_run(const DrivenFlow &flow, const std::vector<CellMembranes *> &membranes);

  /// Whether any do.
  bool acts() const { return !kinds_.empty(); }

  /// The forces times `factor` that the fluid feels, three numbers for each of this rank's atoms.
  /// Valid until the next call of any function. Until smooth_velocities() has returned nobody else
  /// may use the work rows of the exchange. Collective.
  const double *smooth_forces(const double *force, double factor);

  /// To be called in place of smooth_forces() where there are no forces: smooth_velocities() then
  /// adds no slip. Not collective.
  void leave_out_forces();

  /// Makes of the velocities that the grid gives vertices with these forces those with which they
  /// move. Other atoms keep theirs. Collective.
  void smooth_velocities(double *velocity);

  void report_to(const std::shared_ptr<CollectiveStop> & /*stop*/) override {}
  std::vector<Section> sections() override { return {{"Smoothing", &stopwatch_}}; }
  std::size_t bytes() const;

 private:
  using Row = rbc::SurfaceFilter::Row;
  /// Of two cells, which are filtered together: three values of each, the others are padding.
  using TwoRows = Eigen::Array<double, 8, 1>;

  /// The cells of one fix rbc/membrane.
  struct Kind {
    CellMembranes *membranes;
    rbc::SurfaceFilter filter;
    std::vector<double> kept, lost;    ///< linear parts of the function, of each cell here
  };

  RowExchange &exchange_;
  std::vector<Kind> kinds_;
  AtomRows &force_;    ///< that is felt; while cells that ranks share are filtered, the function
  AtomRows &rough_;    ///< tractions
  std::vector<TwoRows> cells_, scratch_;
  std::vector<Row> after_;    ///< a pass, of the vertices of cells that ranks share
  double slip_ = 0;           ///< SLIP dx / viscosity
  rbc::Stopwatch stopwatch_;

  template <class Function>
  void for_owned(const LocalCells::Cell &cell, const Kind &kind, Function function) const;
  template <class Function> void for_shared_vertices(const Kind &kind, Function function) const;
  template <class Load, class Store> void filter(Load load, Store store);
  template <class Load, class Store> void filter_whole_cells(Load load, Store store);
  void filter_shared_cells();
  void take_linear(Kind &kind, std::vector<double> &parts);
  void add_linear(const Kind &kind, const std::vector<double> &parts, double factor);
};

}    // namespace LAMMPS_NS

#endif
