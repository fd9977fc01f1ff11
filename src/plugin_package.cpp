// The package PLUGIN for a LAMMPS library without it, as Debian's is. An executable defines three
// functions of the library again, which then calls these in their place: LAMMPS is made anew by
// `clear`, and plugins are to be there before the first command and after each `clear`.

#include "input.h"
#include "lammps.h"
#include "plugin.h"

#include <dlfcn.h>

using namespace LAMMPS_NS;

namespace {

bool loaded = false;

/// What the library itself has under this symbol. A member function takes its object first.
template <class Object> void call_library(const char *symbol, Object *object)
{
  reinterpret_cast<void (*)(Object *)>(dlsym(RTLD_NEXT, symbol))(object);
}

void load_plugins(LAMMPS *lmp)
{
  if (loaded) return;
  loaded = true;
  (*lmp->input->command_map)["plugin"] = [](LAMMPS *owner) -> Command * {
    return new Plugin(owner);
  };
  plugin_auto_load(lmp);
}

}    // namespace

void Input::file()
{
  load_plugins(lmp);
  call_library("_ZN9LAMMPS_NS5Input4fileEv", this);
}

void LAMMPS::create()
{
  call_library("_ZN9LAMMPS_NS6LAMMPS6createEv", this);
  load_plugins(this);
}

void LAMMPS::destroy()
{
  plugin_clear(this);
  loaded = false;
  call_library("_ZN9LAMMPS_NS6LAMMPS7destroyEv", this);
}
