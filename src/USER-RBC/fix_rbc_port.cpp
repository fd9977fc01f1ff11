#include "fix_rbc_port.h"

#include "comm.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "modify.h"
#include "support/rbc_arguments.h"
#include "update.h"

#include <vector>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixRBCPort::FixRBCPort(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), fluid(narg > 3 ? arg[3] : "")
{
  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;

  opening.style = fmt::format("Fix rbc/port {}", id);
  Arguments args(lmp, "fix rbc/port", narg, arg, 4);
  const auto give = [&](Port::Given given) {
    if (opening.given != Port::Given::nothing)
      args.fail("{}: a port has one flow or one pressure", opening.style);
    opening.given = given;
    opening.value = args.number_or_variable();
  };
  args.read({{"region", [&] { opening.region = args.text(); }},
             {"flow", [&] { give(Port::Given::rate); }},
             {"pressure", [&] { give(Port::Given::pressure); }}});
  if (opening.region.empty()) error->all(FLERR, "{} needs a region", opening.style);
}

/* ---------------------------------------------------------------------- */

FixRBCPort::~FixRBCPort()
{
  if (DrivenFlow *const flow = driven_flow()) flow->drop_ports();
}

/* ---------------------------------------------------------------------- */

void FixRBCPort::init()
{
  if (!driven_flow())
    error->all(FLERR, "{}: there is no fix rbc/fluid with ID {}", opening.style, fluid);
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/port cannot be used with minimize");
}

/* ---------------------------------------------------------------------- */

DrivenFlow *FixRBCPort::driven_flow() const
{
  auto *const flow = dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid));
  return flow ? &flow->driven_flow() : nullptr;
}

DrivenFlow *FixRBCPort::flow_with_port() const
{
  DrivenFlow *const flow = driven_flow();
  return flow && flow->ports() && flow->ports()->has(&opening) ? flow : nullptr;
}

/* ----------------------------------------------------------------------
   rate, mean pressure, volume
------------------------------------------------------------------------- */

double FixRBCPort::compute_vector(int n)
{
  DrivenFlow *const flow = flow_with_port();
  if (!flow) return 0;
  if (n == 0) return flow->ports()->rate(&opening);
  return n == 1 ? flow->port_pressure(&opening) : flow->port_volume(&opening);
}

/* ---------------------------------------------------------------------- */

double FixRBCPort::memory_usage()
{
  const DrivenFlow *const flow = flow_with_port();
  return flow ? static_cast<double>(flow->ports()->bytes(&opening)) : 0;
}

/* ----------------------------------------------------------------------
   how all ports respond; the first of them takes it up
------------------------------------------------------------------------- */

void FixRBCPort::write_restart(FILE *fp)
{
  std::vector<double> memory;
  if (DrivenFlow *const flow = flow_with_port()) memory = flow->port_memory();
  if (comm->me != 0) return;
  const double count = static_cast<double>(memory.size());
  const int size = static_cast<int>((1 + memory.size()) * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(&count, sizeof(double), 1, fp);
  fwrite(memory.data(), sizeof(double), memory.size(), fp);
}

void FixRBCPort::restart(char *buffer)
{
  const auto numbers = reinterpret_cast<const double *>(buffer);
  opening.remembered.assign(numbers + 1, numbers + 1 + static_cast<std::size_t>(numbers[0]));
}
