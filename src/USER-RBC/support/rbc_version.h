#ifndef LMP_RBC_VERSION_H
#define LMP_RBC_VERSION_H

namespace LAMMPS_NS {

/// Of this package, as in CMakeLists.txt: "1.2.3".
const char *rbc_version();

}    // namespace LAMMPS_NS

#endif
