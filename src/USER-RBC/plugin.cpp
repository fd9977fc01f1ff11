#include "lammpsplugin.h"
#include "styles.h"

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  const auto register_style = reinterpret_cast<lammpsplugin_regfunc>(regfunc);
  for (auto style : USER_RBC::styles()) {
    style.handle = handle;
    register_style(&style, lmp);
  }
}
