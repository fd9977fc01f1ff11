#include "fix_rbc_port.h"

#include "error.h"
#include "fix_rbc_fluid.h"
#include "modify.h"
#include "support/rbc_arguments.h"
#include "update.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixRBCPort::FixRBCPort(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), fluid(narg > 3 ? arg[3] : "")
{
  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 0;

  opening.style = fmt::format("Fix rbc/port {}", id);
  Arguments args(lmp, "fix rbc/port", narg, arg, 4);
  args.read({{"region", [&] { opening.region = args.text(); }}, {"flow", [&] {
                                                                   opening.rate =
                                                                       args.number_or_variable();
                                                                   opening.has_rate = true;
                                                                 }}});
  if (opening.region.empty()) error->all(FLERR, "{} needs a region", opening.style);
}

/* ---------------------------------------------------------------------- */

void FixRBCPort::init()
{
  fluid_fix = dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid));
  if (!fluid_fix)
    error->all(FLERR, "{}: there is no fix rbc/fluid with ID {}", opening.style, fluid);
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/port cannot be used with minimize");
}

/* ----------------------------------------------------------------------
   rate, mean pressure, volume
------------------------------------------------------------------------- */

double FixRBCPort::compute_vector(int n)
{
  if (!fluid_fix || !fluid_fix->driven_flow().ports()) return 0;
  DrivenFlow &flow = fluid_fix->driven_flow();
  if (n == 0) return flow.ports()->rate(&opening);
  return n == 1 ? flow.port_pressure(&opening) : flow.port_volume(&opening);
}
