#include "coupling/rbc_fluid_settings.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fluid/fourier.h"
#include "support/rbc_arguments.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace {

constexpr int MIN_CELLS = 4;

// on a rank: a message counts three values of each in an int

constexpr double MAX_CELLS = 0.25 * MAXSMALLINT;

class Reader : protected Pointers {
 public:
  Reader(LAMMPS *lmp, int narg, char **arg, FlowForcing &forcing) :
      Pointers(lmp), id(arg[0]), args(lmp, "fix rbc/fluid", narg, arg, 3), forcing(forcing)
  {
  }

  FluidSettings settings;

  void read();
  void check();
  void choose_grid();
  void check_grid() const;

 private:
  const char *id;
  Arguments args;
  FlowForcing &forcing;
  double target_spacing = 0;
  bool wall_given[2] = {false, false};
  bool mean_given = false;

  void read_plate();
  void read_mean();
  void read_inside();
};

/* ---------------------------------------------------------------------- */

void Reader::read()
{
  settings.equations.viscosity = settings.equations.density = 0;
  args.read({{"dx", [&] { target_spacing = args.positive(); }},
             {"grid",
              [&] {
                for (int &cells : settings.cells) cells = args.whole(MIN_CELLS, MAXSMALLINT);
              }},
             {"viscosity", [&] { settings.equations.viscosity = args.positive(); }},
             {"density", [&] { settings.equations.density = args.positive(); }},
             {"inertia",
              [&] {
                settings.equations.inertia =
                    args.choice<fluid::Inertia>({{"none", fluid::Inertia::none},
                                                 {"unsteady", fluid::Inertia::unsteady},
                                                 {"convective", fluid::Inertia::convective}});
              }},
             {"scheme",
              [&] {
                settings.equations.scheme =
                    args.choice<fluid::Scheme>({{"coupled", fluid::Scheme::coupled},
                                                {"projection", fluid::Scheme::projection}});
              }},
             {"wall", [&] { read_plate(); }},
             {"body", [&] { forcing.body = args.vector(); }},
             {"mean", [&] { read_mean(); }},
             {"inside", [&] { read_inside(); }}});
}

/* ---------------------------------------------------------------------- */

void Reader::read_plate()
{
  const std::string side = args.text();
  if (side != "zlo" && side != "zhi")
    args.fail("Fix rbc/fluid wall side {} must be zlo or zhi", side);
  if (domain->zperiodic)
    args.fail("Fix rbc/fluid wall {} on a periodic side: z must be fixed (boundary p p f)", side);
  wall_given[side == "zhi"] = true;
  fluid::PlateConditions &conditions = settings.plate_conditions;
  fluid::PlateCondition &condition = side == "zlo" ? conditions.lower : conditions.upper;
  FlowForcing::Vector &velocity = side == "zlo" ? forcing.lower : forcing.upper;
  if (args.take("slip")) {
    condition = fluid::PlateCondition::free_slip;
    velocity = {};
    return;
  }
  condition = fluid::PlateCondition::no_slip;
  velocity = args.vector();
  if (velocity[2].is_variable() || velocity[2].value(lmp) != 0)
    args.fail("Fix rbc/fluid wall {} velocity along z must be 0: plates move along themselves",
              side);
}

/* ----------------------------------------------------------------------
   the mean velocity of the whole box, or the one inside a vessel along a direction
------------------------------------------------------------------------- */

void Reader::read_mean()
{
  const std::string first = args.peek();
  for (int d = 0; d < 3; ++d) {
    if (!args.take(std::string(1, "xyz"[d]))) continue;
    if (d == 2 && !domain->zperiodic)
      args.fail("Fix rbc/fluid mean z needs a triply periodic box: plates let no flow through");
    if (forcing.held_direction() >= 0 && forcing.held_direction() != d)
      args.fail("Fix rbc/fluid mean {} after mean {}: only one direction can be held", first,
                "xyz"[forcing.held_direction()]);
    forcing.hold_inside(d, args.number_or_variable());
    return;
  }
  const bool by_forces = args.take("force");
  const FlowForcing::Vector mean = by_forces ? FlowForcing::Vector() : args.vector();
  if (!domain->zperiodic)
    args.fail("Fix rbc/fluid mean {} needs a triply periodic box: between plates the mean flow "
              "follows from them; mean x or y V holds one by a body force",
              first);
  if (mean_given && by_forces != settings.free_mean)
    args.fail("Fix rbc/fluid takes either mean force or mean vx vy vz, not both");
  settings.free_mean = by_forces;
  mean_given = true;
  if (!by_forces) forcing.mean = mean;
}

void Reader::read_inside()
{
  settings.inside = args.text();
  if (!domain->get_region_by_id(settings.inside))
    args.fail("Region ID {} for fix rbc/fluid inside does not exist", settings.inside);
}

/* ---------------------------------------------------------------------- */

void Reader::check()
{
  settings.plates = !domain->zperiodic;
  if (settings.plates && !(wall_given[0] && wall_given[1]))
    error->all(FLERR, "Fix rbc/fluid needs wall zlo and wall zhi where z is not periodic");
  const bool inertia = settings.equations.inertia != fluid::Inertia::none;
  if (settings.plates && !inertia && !settings.plate_conditions.hold_the_flow())
    error->all(FLERR,
               "Fix rbc/fluid wall slip on both sides needs inertia unsteady or convective: "
               "nothing would hold the mean velocity of a steady flow; give one of the plates a "
               "velocity");
  if (!inertia && settings.equations.scheme == fluid::Scheme::projection)
    error->all(FLERR,
               "Fix rbc/fluid scheme projection needs inertia unsteady or convective: steady "
               "flow has no step to split");
  if (inertia && forcing.held_direction() >= 0)
    error->all(FLERR, "Fix rbc/fluid mean {} needs inertia none", "xyz"[forcing.held_direction()]);
  settings.prescribed_mean = mean_given && !settings.free_mean;
  settings.equations.hold_mean = !inertia || settings.prescribed_mean;
  if (target_spacing == 0 && settings.cells[0] == 0)
    error->all(FLERR, "Fix rbc/fluid needs dx or grid");
  if (target_spacing > 0 && settings.cells[0] > 0)
    error->all(FLERR, "Fix rbc/fluid takes either dx or grid, not both");
  if (settings.equations.viscosity == 0) error->all(FLERR, "Fix rbc/fluid needs viscosity");
  if (inertia && settings.equations.density == 0)
    error->all(FLERR, "Fix rbc/fluid needs density with inertia unsteady or convective");
}

/* ----------------------------------------------------------------------
   spacing as near to dx as a whole number of cells allows; where the grid is transformed, not
   coarser, and of numbers of cells without large prime factors
------------------------------------------------------------------------- */

void Reader::choose_grid()
{
  if (target_spacing == 0) return;
  bool changed = false;
  for (int d = 0; d < 3; ++d) {
    const double wanted = std::round(domain->prd[d] / target_spacing);
    const double largest = domain->prd[d] / MIN_CELLS;
    if (wanted < MIN_CELLS)
      error->all(
          FLERR,
          "Fix rbc/fluid dx {} leaves {} cells in {}; at least {} are needed (dx at most {})",
          target_spacing, wanted, "xyz"[d], MIN_CELLS, largest);
    settings.cells[d] = static_cast<int>(std::min<double>(wanted, MAXSMALLINT));
    if (settings.cells[d] > MAX_CELLS || (settings.plates && d == 2)) continue;
    settings.cells[d] = fluid::fast_size(settings.cells[d]);
    changed = changed || settings.cells[d] != wanted;
  }
  if (changed && comm->me == 0)
    utils::logmesg(
        lmp,
        "Fix rbc/fluid {}: for fast Fourier transforms the grid is made a little finer than dx {} "
        "asks for: {} x {} x {} cells, spacing {:.6g} {:.6g} {:.6g}\n",
        id, target_spacing, settings.cells[0], settings.cells[1], settings.cells[2],
        domain->prd[0] / settings.cells[0], domain->prd[1] / settings.cells[1],
        domain->prd[2] / settings.cells[2]);
}

/* ----------------------------------------------------------------------
   LAMMPS counts the cells of a rank in an int
------------------------------------------------------------------------- */

void Reader::check_grid() const
{
  const double each =
      double(settings.cells[0]) * settings.cells[1] * settings.cells[2] / comm->nprocs;
  if (each > MAX_CELLS)
    error->all(
        FLERR,
        "Fix rbc/fluid {} {} asks for {:.3g} cells per MPI task; at most {:.3g} are possible",
        target_spacing > 0 ? "dx" : "grid",
        target_spacing > 0
            ? fmt::format("{}", target_spacing)
            : fmt::format("{} {} {}", settings.cells[0], settings.cells[1], settings.cells[2]),
        each, MAX_CELLS);
}

}    // namespace

/* ---------------------------------------------------------------------- */

FluidSettings LAMMPS_NS::read_fluid_settings(LAMMPS *lmp, int narg, char **arg,
                                             FlowForcing &forcing)
{
  Reader reader(lmp, narg, arg, forcing);
  reader.read();
  reader.check();
  reader.choose_grid();
  reader.check_grid();
  return reader.settings;
}
