// Makes the package's styles part of lmp_rbc, whose main() is LAMMPS's own.

#include "domain.h"
#include "force.h"
#include "input.h"
#include "modify.h"
#include "styles.h"

#include <dlfcn.h>

using namespace LAMMPS_NS;

namespace {

void add_style(LAMMPS *lmp, const lammpsplugin_t &style)
{
  const std::string kind = style.style;
  if (kind == "command")
    (*lmp->input->command_map)[style.name] =
        reinterpret_cast<Input::CommandCreator>(style.creator.v1);
  else if (kind == "compute")
    (*lmp->modify->compute_map)[style.name] =
        reinterpret_cast<Modify::ComputeCreator>(style.creator.v2);
  else if (kind == "fix")
    (*lmp->modify->fix_map)[style.name] = reinterpret_cast<Modify::FixCreator>(style.creator.v2);
  else if (kind == "pair")
    (*lmp->force->pair_map)[style.name] = reinterpret_cast<Force::PairCreator>(style.creator.v1);
  else if (kind == "region")
    (*lmp->domain->region_map)[style.name] =
        reinterpret_cast<Domain::RegionCreator>(style.creator.v2);
}

}    // namespace

namespace LAMMPS_NS {

// LAMMPS calls this at the end of LAMMPS::create(), so at the start and after each `clear`. A function
// of the executable takes the place of the library's of the same name, which it then calls.
void plugin_auto_load(LAMMPS *lmp)
{
  for (const auto &style : USER_RBC::styles()) add_style(lmp, style);

  using AutoLoad = void (*)(LAMMPS *);
  void *original = dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS16plugin_auto_loadEPNS_6LAMMPSE");
  if (original) reinterpret_cast<AutoLoad>(original)(lmp);
}

}    // namespace LAMMPS_NS
