#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/port,FixRBCPort);
// clang-format on
#else

#ifndef LMP_FIX_RBC_PORT_H
#define LMP_FIX_RBC_PORT_H

#include "coupling/rbc_fluid_client.h"
#include "coupling/rbc_port.h"
#include "fix.h"

#include <cstdio>
#include <string>

namespace LAMMPS_NS {

/// An opening of a vessel: arguments, checks and output.
class FixRBCPort : public Fix, public FluidClient {
 public:
  FixRBCPort(class LAMMPS *, int, char **);
  ~FixRBCPort() override;
  int setmask() override { return 0; }
  void init() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  const std::string &fluid_id() const override { return fluid; }
  Port *port() override { return &opening; }
  class DrivenFlow *driven_flow() const;    ///< null once its fix is deleted

 private:
  std::string fluid;
  Port opening;

  class DrivenFlow *flow_with_port() const;    ///< null until a run has begun with this port
};

}    // namespace LAMMPS_NS

#endif
#endif
