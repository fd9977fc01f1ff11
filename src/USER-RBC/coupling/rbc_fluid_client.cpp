#include "coupling/rbc_fluid_client.h"

#include "fix.h"
#include "modify.h"

using namespace LAMMPS_NS;

std::vector<FluidClient *> LAMMPS_NS::fluid_clients(Modify *modify)
{
  std::vector<FluidClient *> clients;
  for (Fix *fix : modify->get_fix_list())
    if (auto *const client = dynamic_cast<FluidClient *>(fix)) clients.push_back(client);
  return clients;
}
