#include "styles.h"

#include "command.h"
#include "compute.h"
#include "fix.h"
#include "pair.h"
#include "region.h"
#include "style_headers.h"
#include "support/rbc_out_of_memory.h"
#include "version.h"

using namespace LAMMPS_NS;

namespace {

using Creator = decltype(lammpsplugin_t::creator);

template <class Base, class Style> Creator plain()
{
  Base *(*create)(LAMMPS *) = [](LAMMPS *lmp) -> Base * { return new Style(lmp); };
  Creator creator;
  creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(create);
  return creator;
}

template <class Base, class Style> Creator with_arguments()
{
  Base *(*create)(LAMMPS *, int, char **) = [](LAMMPS *lmp, int narg, char **arg) -> Base * {
    Base *style = nullptr;
    do_or_run_out(lmp, "USER-RBC", [&] { style = new Style(lmp, narg, arg); });
    return style;
  };
  Creator creator;
  creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(create);
  return creator;
}

}    // namespace

std::vector<lammpsplugin_t> USER_RBC::styles()
{
  std::vector<lammpsplugin_t> table;

#define ADD_STYLE(kind, key, creator)                                                              \
  table.push_back({LAMMPS_VERSION, kind, #key, kind " " #key " (USER-RBC)", "USER-RBC developers", \
                   creator, nullptr})
#define COMMAND_CLASS
#define CommandStyle(key, Class) ADD_STYLE("command", key, (plain<Command, Class>()))
#define COMPUTE_CLASS
#define ComputeStyle(key, Class) ADD_STYLE("compute", key, (with_arguments<Compute, Class>()))
#define FIX_CLASS
#define FixStyle(key, Class) ADD_STYLE("fix", key, (with_arguments<Fix, Class>()))
#define PAIR_CLASS
#define PairStyle(key, Class) ADD_STYLE("pair", key, (plain<Pair, Class>()))
#define REGION_CLASS
#define RegionStyle(key, Class) ADD_STYLE("region", key, (with_arguments<Region, Class>()))
#include "style_headers.h"

  return table;
}
