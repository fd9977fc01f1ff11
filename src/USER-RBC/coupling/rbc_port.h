#ifndef LMP_RBC_PORT_H
#define LMP_RBC_PORT_H

#include "support/rbc_number_or_variable.h"

#include <string>

namespace LAMMPS_NS {

/// An opening of a vessel, as its fix describes it.
struct Port {
  std::string style;    ///< the fix, for messages
  std::string region;
  bool has_rate = false;    ///< given; otherwise the port takes what is left by the others
  NumberOrVariable rate;    ///< of the fluid that enters, volume per time
};

}    // namespace LAMMPS_NS

#endif
