#include "support/rbc_version.h"

const char *LAMMPS_NS::rbc_version()
{
  return RBC_VERSION;
}
