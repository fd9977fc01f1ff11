#ifndef LMP_RBC_GRID_OUTPUT_H
#define LMP_RBC_GRID_OUTPUT_H

#include "coupling/rbc_cell_fraction.h"
#include "fluid/flow.h"
#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

/// The flow at the centres of cells, in LAMMPS's arrays, as dumps and fix ave/grid ask for it. Each
/// array is made when first asked for and filled at most once a version of the flow; the pressure
/// and the share of cells cost a solve each.
class GridOutput : protected Pointers {
 public:
  explicit GridOutput(LAMMPS *lmp) : Pointers(lmp), fraction_(lmp) {}
  GridOutput(const GridOutput &) = delete;
  GridOutput &operator=(const GridOutput &) = delete;
  ~GridOutput() override { free(); }

  /// -1 if there is no such data; else its index and number of columns.
  static int find(const std::string &name, int &columns);

  /// Collective: all ranks ask in the same order. Null if there is no such index.
  void *get(int index, fluid::Flow &flow, const std::array<double, 3> &uniform_force,
            bigint version);

  /// Frees all arrays; call before the flow's brick changes.
  void free();

  double bytes() const;

 private:
  enum Kind { VELOCITY, PRESSURE, FORCE, INTERIOR, KINDS };

  static constexpr bigint NONE = -1;

  std::array<void *, KINDS> data_{};
  std::array<bigint, KINDS> version_{NONE, NONE, NONE, NONE};    ///< of the flow in data_
  fluid::Box box_;
  CellFraction fraction_;

  static bool is_scalar(int index) { return index == PRESSURE || index == INTERIOR; }

  void *allocate(int index);
  void fill_scalar(int index, const fluid::ScalarField &centres, double scale);
  void fill_vector(int index, const fluid::VectorField *faces, const std::array<double, 3> &uniform,
                   double scale);
};

}    // namespace LAMMPS_NS

#endif
