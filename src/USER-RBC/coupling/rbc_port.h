#ifndef LMP_RBC_PORT_H
#define LMP_RBC_PORT_H

#include "support/rbc_number_or_variable.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// An opening of a vessel, as its fix describes it.
struct Port {
  std::string style;    ///< the fix, for messages
  std::string region;

  /// What is given: the volume of fluid that enters per time, the pressure, or nothing: the port
  /// takes what the others leave.
  enum class Given { rate, pressure, nothing };
  Given given = Given::nothing;
  NumberOrVariable value;

  std::vector<double> remembered;    ///< from a restart file, of all ports, until a run begins
};

}    // namespace LAMMPS_NS

#endif
