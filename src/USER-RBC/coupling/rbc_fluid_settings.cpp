#include "coupling/rbc_fluid_settings.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fluid/fourier.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

namespace {

constexpr int MIN_CELLS = 4;

// on a rank: a message counts three values of each in an int

constexpr double MAX_CELLS = 0.25 * MAXSMALLINT;

class Reader : protected Pointers {
 public:
  Reader(LAMMPS *lmp, const char *id, FlowForcing &forcing) :
      Pointers(lmp), id(id), forcing(forcing)
  {
  }

  FluidSettings settings;

  void parse(int narg, char **arg);
  void choose_grid();
  void check_grid() const;

 private:
  const char *id;
  FlowForcing &forcing;
  double target_spacing = 0;

  void parse_vector(int iarg, int narg, char **arg, const char *keyword,
                    FlowForcing::Vector &vector);
};

/* ---------------------------------------------------------------------- */

void Reader::parse_vector(int iarg, int narg, char **arg, const char *keyword,
                          FlowForcing::Vector &vector)
{
  if (iarg + 3 > narg)
    utils::missing_cmd_args(FLERR, std::string("fix rbc/fluid ") + keyword, error);
  for (int d = 0; d < 3; ++d) vector[d] = NumberOrVariable(lmp, arg[iarg + d]);
}

/* ---------------------------------------------------------------------- */

void Reader::parse(int narg, char **arg)
{
  bool wall_given[2] = {false, false};
  bool mean_given = false;
  settings.equations.viscosity = settings.equations.density = 0;
  int iarg = 3;
  const auto need = [&](int n, const char *keyword) {
    if (iarg + n >= narg)
      utils::missing_cmd_args(FLERR, std::string("fix rbc/fluid ") + keyword, error);
  };
  const auto positive = [&](int at, const char *keyword) {
    const double value = utils::numeric(FLERR, arg[at], false, lmp);
    if (!(value > 0))
      error->all(FLERR, at, "Fix rbc/fluid {} value {} must be > 0", keyword, arg[at]);
    return value;
  };

  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    if (keyword == "dx") {
      need(1, "dx");
      target_spacing = positive(iarg + 1, "dx");
      iarg += 2;
    } else if (keyword == "grid") {
      need(3, "grid");
      for (int d = 0; d < 3; ++d) {
        settings.cells[d] = utils::inumeric(FLERR, arg[iarg + 1 + d], false, lmp);
        if (settings.cells[d] < MIN_CELLS)
          error->all(FLERR, iarg + 1 + d,
                     "Fix rbc/fluid grid value {} must be at least {} cells in every direction",
                     arg[iarg + 1 + d], MIN_CELLS);
      }
      iarg += 4;
    } else if (keyword == "viscosity") {
      need(1, "viscosity");
      settings.equations.viscosity = positive(iarg + 1, "viscosity");
      iarg += 2;
    } else if (keyword == "density") {
      need(1, "density");
      settings.equations.density = positive(iarg + 1, "density");
      iarg += 2;
    } else if (keyword == "inertia") {
      need(1, "inertia");
      const std::string value = arg[iarg + 1];
      if (value == "none")
        settings.equations.inertia = fluid::Inertia::none;
      else if (value == "unsteady")
        settings.equations.inertia = fluid::Inertia::unsteady;
      else if (value == "convective")
        settings.equations.inertia = fluid::Inertia::convective;
      else
        error->all(FLERR, iarg + 1,
                   "Unknown fix rbc/fluid inertia {}; allowed: none, unsteady, convective", value);
      iarg += 2;
    } else if (keyword == "scheme") {
      need(1, "scheme");
      const std::string value = arg[iarg + 1];
      if (value == "coupled")
        settings.equations.scheme = fluid::Scheme::coupled;
      else if (value == "projection")
        settings.equations.scheme = fluid::Scheme::projection;
      else
        error->all(FLERR, iarg + 1, "Unknown fix rbc/fluid scheme {}; allowed: coupled, projection",
                   value);
      iarg += 2;
    } else if (keyword == "wall") {
      need(1, "wall");
      const std::string side = arg[iarg + 1];
      if (side != "zlo" && side != "zhi")
        error->all(FLERR, iarg + 1, "Fix rbc/fluid wall side {} must be zlo or zhi", side);
      if (domain->zperiodic)
        error->all(FLERR, iarg,
                   "Fix rbc/fluid wall {} on a periodic side: z must be fixed (boundary p p f)",
                   side);
      parse_vector(iarg + 2, narg, arg, "wall", side == "zlo" ? forcing.lower : forcing.upper);
      const NumberOrVariable &normal = (side == "zlo" ? forcing.lower : forcing.upper)[2];
      if (normal.is_variable() || normal.value(lmp) != 0)
        error->all(
            FLERR, iarg + 4,
            "Fix rbc/fluid wall {} velocity {} along z must be 0: plates move along themselves",
            side, arg[iarg + 4]);
      wall_given[side == "zhi"] = true;
      iarg += 5;
    } else if (keyword == "body") {
      parse_vector(iarg + 1, narg, arg, "body", forcing.body);
      iarg += 4;
    } else if (keyword == "mean") {
      need(1, "mean");
      const std::string value = arg[iarg + 1];
      if (value == "x" || value == "y" || value == "z") {
        need(2, "mean");
        if (value == "z" && !domain->zperiodic)
          error->all(
              FLERR, iarg + 1,
              "Fix rbc/fluid mean z needs a triply periodic box: plates let no flow through");
        forcing.hold_inside(value[0] - 'x', NumberOrVariable(lmp, arg[iarg + 2]));
        iarg += 3;
        continue;
      }
      if (!domain->zperiodic)
        error->all(
            FLERR, iarg,
            "Fix rbc/fluid mean {} needs a triply periodic box: between plates the mean flow "
            "follows from them; mean x or y V holds one by a body force",
            value);
      mean_given = true;
      if (value == "force") {
        settings.free_mean = true;
        iarg += 2;
      } else {
        settings.free_mean = false;
        parse_vector(iarg + 1, narg, arg, "mean", forcing.mean);
        iarg += 4;
      }
    } else if (keyword == "inside") {
      need(1, "inside");
      settings.inside = arg[iarg + 1];
      if (!domain->get_region_by_id(settings.inside))
        error->all(FLERR, iarg + 1, "Region ID {} for fix rbc/fluid inside does not exist",
                   settings.inside);
      iarg += 2;
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/fluid keyword {}; allowed: dx, grid, viscosity, density, "
                 "inertia, scheme, wall, body, mean, inside",
                 keyword);
  }

  settings.plates = !domain->zperiodic;
  if (settings.plates && !(wall_given[0] && wall_given[1]))
    error->all(FLERR, "Fix rbc/fluid needs wall zlo and wall zhi where z is not periodic");
  const bool inertia = settings.equations.inertia != fluid::Inertia::none;
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
  if (settings.equations.density == 0) error->all(FLERR, "Fix rbc/fluid needs density");
}

/* ----------------------------------------------------------------------
   spacing as near to dx as a whole number of cells allows; where the grid is transformed, not coarser, and of
   numbers of cells without large prime factors
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
        "Fix rbc/fluid {}: grid of {} x {} x {} cells, spacing {:.6g} {:.6g} {:.6g}: dx {} "
        "alone would give numbers of cells that are slow to transform\n",
        id, settings.cells[0], settings.cells[1], settings.cells[2],
        domain->prd[0] / settings.cells[0], domain->prd[1] / settings.cells[1],
        domain->prd[2] / settings.cells[2], target_spacing);
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
  Reader reader(lmp, arg[0], forcing);
  reader.parse(narg, arg);
  reader.choose_grid();
  reader.check_grid();
  return reader.settings;
}
