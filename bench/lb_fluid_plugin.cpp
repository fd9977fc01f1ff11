// LAMMPS's fix lb/fluid as a plugin, in place of the one built in: the same source, under a name of
// its own for the linker.
#define FixLbFluid FixLbFluidOfPlugin
#include "fix_lb_fluid.cpp"

#include "lammpsplugin.h"
#include "version.h"

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  lammpsplugin_t style{};
  style.version = LAMMPS_VERSION;
  style.style = "fix";
  style.name = "lb/fluid";
  style.info = "fix lb/fluid of the LATBOLTZ package";
  style.author = "the authors of LATBOLTZ";
  style.creator.v2 = [](void *lammps, int narg, char **arg) -> void * {
    return static_cast<Fix *>(new FixLbFluid(static_cast<LAMMPS *>(lammps), narg, arg));
  };
  style.handle = handle;
  reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&style, lmp);
}
