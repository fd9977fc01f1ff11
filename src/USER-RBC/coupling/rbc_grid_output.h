#ifndef LMP_RBC_GRID_OUTPUT_H
#define LMP_RBC_GRID_OUTPUT_H

#include "fluid/flow.h"
#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

/// The flow at the centres of cells, in LAMMPS's arrays, as dumps and fix ave/grid ask for it. Each
/// array is made when first asked for and filled at most once a version of the flow; the pressure
/// costs a solve.
class GridOutput : protected Pointers {
 public:
  using Pointers::Pointers;
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
  enum Kind { VELOCITY, PRESSURE, FORCE, KINDS };

  std::array<void *, KINDS> data_{};
  std::array<bigint, KINDS> version_{};
  fluid::Box box_;

  void *allocate(int index);
  void fill_pressure(fluid::Flow &flow);
  void fill_vector(int index, const fluid::VectorField *faces, const std::array<double, 3> &uniform,
                   double scale);
};

}    // namespace LAMMPS_NS

#endif
