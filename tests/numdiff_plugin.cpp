// Fixes numdiff and numdiff/virial of LAMMPS's package EXTRA-FIX as a plugin, for tests with a
// LAMMPS library without that package.

#include "fix_numdiff.h"
#include "fix_numdiff_virial.h"
#include "lammpsplugin.h"
#include "version.h"

using namespace LAMMPS_NS;

template <class Style> static Fix *create(LAMMPS *lmp, int narg, char **arg)
{
  return new Style(lmp, narg, arg);
}

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  const auto add = [=](const char *name, Fix *(*creator)(LAMMPS *, int, char **)) {
    lammpsplugin_t style{LAMMPS_VERSION, "fix", name, name, "LAMMPS developers", {}, handle};
    style.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(creator);
    reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&style, lmp);
  };
  add("numdiff", create<FixNumDiff>);
  add("numdiff/virial", create<FixNumDiffVirial>);
}
