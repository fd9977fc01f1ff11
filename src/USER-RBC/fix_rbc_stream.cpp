#include "fix_rbc_stream.h"

#include "cells/rbc_cell_membranes.h"
#include "cells/rbc_cell_template.h"
#include "cells/rbc_whole_cells.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_rbc_port.h"
#include "group.h"
#include "modify.h"
#include "support/rbc_arguments.h"
#include "update.h"

#include <algorithm>
#include <tuple>

using namespace LAMMPS_NS;
using namespace FixConst;
using rbc::Vec3;

// numbers of the output: of all openings, then of each outlet

static constexpr int NUMBERS = 8, OUTLET_NUMBERS = 3;

/* ---------------------------------------------------------------------- */

FixRBCStream::FixRBCStream(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), style(fmt::format("Fix rbc/stream {}", id)), port(narg > 3 ? arg[3] : "")
{
  parse(narg, arg);
  ledger.emplace(hematocrit, static_cast<int>(outlets.size()));
  placement.emplace(*shape, gap, seed);

  vector_flag = 1;
  size_vector = NUMBERS + OUTLET_NUMBERS * static_cast<int>(outlets.size());
  if (along >= 0) ++size_vector;
  global_freq = 1;
  extvector = 0;
  nevery = 1;
  restart_global = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::parse(int narg, char **arg)
{
  std::string molecule;
  Arguments args(lmp, "fix rbc/stream", narg, arg, 4);
  args.read({{"region", [&] { region = args.text(); }},
             {"hematocrit", [&] { hematocrit = args.between(0, 1); }},
             {"molecule", [&] { molecule = args.text(); }},
             {"seed", [&] { seed = args.whole(1, MAXSMALLINT); }},
             {"outlet",
              [&] {
                const std::string outlet = args.text();
                outlets.push_back({outlet, args.text()});
              }},
             {"type", [&] { cell_type = args.atom_type(); }},
             {"overlap", [&] { gap = args.positive(); }},
             {"attempts", [&] { attempts = args.whole(1, MAXSMALLINT); }},
             {"every", [&] { every = args.whole(1, MAXSMALLINT); }},
             {"periodic", [&] { read_direction(args); }}});
  const std::pair<const char *, bool> needed[] = {{"region", !region.empty()},
                                                  {"hematocrit", hematocrit > 0},
                                                  {"molecule", !molecule.empty()},
                                                  {"seed", seed > 0}};
  for (const auto &[word, given] : needed)
    if (!given) error->all(FLERR, "{} needs {}", style, word);
  if (igroup == 0)
    error->all(FLERR, "{} cannot use group all: give it the group of a fix rbc/membrane", style);
  shape = make_cell_template(lmp, molecule, "fix rbc/stream molecule");
  if (gap < 0) gap = shape->mean_edge / 10;
}

void FixRBCStream::read_direction(Arguments &args)
{
  using Direction = std::pair<int, bool>;
  const Arguments::Choices<Direction> directions = {{"x", {0, true}},   {"y", {1, true}},
                                                    {"z", {2, true}},   {"-x", {0, false}},
                                                    {"-y", {1, false}}, {"-z", {2, false}}};
  std::tie(along, upwards) = args.choice<Direction>(directions);
}

/* ---------------------------------------------------------------------- */

int FixRBCStream::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | END_OF_STEP | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::init()
{
  if (domain->triclinic) error->all(FLERR, "{} requires an orthogonal simulation box", style);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/stream cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/stream cannot be used with minimize");
  check_ports();
  find_membranes();
  check_moved();
  find_feed();
  warned = false;
  leavers.clear();
  arrivals.clear();
  copies.clear();
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::check_ports()
{
  std::vector<std::string> seen{port};
  find_port(port);
  for (const Outlet &outlet : outlets) {
    find_port(outlet.port);
    if (std::find(seen.begin(), seen.end(), outlet.port) != seen.end())
      error->all(FLERR, "{}: fix rbc/port {} is named twice; each opening has a port of its own",
                 style, outlet.port);
    seen.push_back(outlet.port);
  }
}

FixRBCPort *FixRBCStream::find_port(const std::string &name) const
{
  auto *const found = dynamic_cast<FixRBCPort *>(modify->get_fix_by_id(name));
  if (!found) error->all(FLERR, "{}: there is no fix rbc/port with ID {}", style, name);
  return found;
}

/* ----------------------------------------------------------------------
   those that hold the cells of the group together, null if there are none
------------------------------------------------------------------------- */

CellMembranes *FixRBCStream::membranes_of_group() const
{
  for (CellMembranes *cells : all_cell_membranes(lmp))
    if (cells->groupbit() == groupbit) return cells;
  return nullptr;
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::find_membranes()
{
  membranes = membranes_of_group();
  if (!membranes)
    error->all(FLERR, "{}: there is no fix rbc/membrane of its group, {}", style,
               group->names[igroup]);
  if (membranes->shape().triangles != shape->triangles)
    error->all(FLERR, "{}: its molecule must have the triangles of that of f{}", style,
               membranes->style().substr(1));
  ledger->set_cell_volume(membranes->swelling().now() * membranes->shape().volume);
}

/* ----------------------------------------------------------------------
   New cells belong to this group, to all, and to the group of the fix rbc/ib of this flow, which
   may move other kinds of cells, too. The rates of ports are known once that fix has had its turn
   at the start of a run.
------------------------------------------------------------------------- */

void FixRBCStream::check_moved()
{
  const std::string &fluid = find_port(port)->fluid_id();
  bool before = true;
  for (const Fix *fix : modify->get_fix_list()) {
    if (fix == this) before = false;
    const auto *const client = dynamic_cast<const FluidClient *>(fix);
    if (!client || !client->drives_flow() || client->fluid_id() != fluid) continue;
    if (!before) error->all(FLERR, "{} must be defined after fix rbc/ib {}", style, fix->id);
    if (group->dynamic[fix->igroup])
      error->all(FLERR, "{}: group {} of fix rbc/ib {} must not be dynamic", style,
                 group->names[fix->igroup], fix->id);
    moved_groupbit = fix->groupbit;
    return;
  }
  error->all(FLERR, "{}: new cells would not be moved: there is no fix rbc/ib of fix rbc/fluid {}",
             style, fluid);
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::setup(int /*vflag*/)
{
  ledger->start(rate_through(port), rates_out());
}

void FixRBCStream::end_of_step()
{
  const double due = ledger->pass(update->dt, rate_through(port), rates_out());
  if (stretch) stretch->pass(due);
}

double FixRBCStream::rate_through(const std::string &name) const
{
  return find_port(name)->compute_vector(0);
}

std::vector<double> FixRBCStream::rates_out() const
{
  std::vector<double> rates;
  for (const Outlet &outlet : outlets) rates.push_back(-rate_through(outlet.port));
  return rates;
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::post_run()
{
  if (comm->me == 0 && ledger->owed() > 1.5)
    error->warning(FLERR,
                   "{}: {:.3g} cells are owed at the end of the run; the discharge hematocrit of "
                   "what entered is {:.4g}, not {:.4g}",
                   style, ledger->owed(), ledger->inlet().hematocrit(), hematocrit);
}

/* ----------------------------------------------------------------------
   1 cells that entered, 2 that left, 3 inside, 4 owed; 5-6 discharge hematocrit in and out, 7-8
   volume in and out; then of each outlet cells, discharge hematocrit, volume; then of a periodic
   stretch the length of its loop
------------------------------------------------------------------------- */

double FixRBCStream::compute_vector(int n)
{
  const rbc::StreamLedger::Passage &in = ledger->inlet();
  const rbc::StreamLedger::Passage left = ledger->left();
  if (n == NUMBERS + OUTLET_NUMBERS * static_cast<int>(outlets.size()))
    return stretch ? stretch->loop() : 0;
  if (n >= NUMBERS) {
    const auto &outlet = ledger->outlet((n - NUMBERS) / OUTLET_NUMBERS);
    const double number[] = {outlet.cells, outlet.hematocrit(), outlet.volume};
    return number[(n - NUMBERS) % OUTLET_NUMBERS];
  }
  CellMembranes *const now = membranes_of_group();    // between runs they may be gone
  double inside = now ? static_cast<double>(now->local_cells().count()) : 0;
  if (now && stretch) inside -= static_cast<double>(stretch->before());
  const double number[] = {in.cells,        left.cells,        inside,    ledger->owed(),
                           in.hematocrit(), left.hematocrit(), in.volume, left.volume};
  return number[n];
}

/* ---------------------------------------------------------------------- */

void FixRBCStream::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  const std::vector<double> account = ledger->state();
  std::vector<double> state{0, static_cast<double>(placement->drawn()),
                            static_cast<double>(last_atom), static_cast<double>(last_molecule),
                            static_cast<double>(account.size())};
  state.insert(state.end(), account.begin(), account.end());
  const std::vector<double> loop = stretch ? stretch->state() : remembered;
  state.insert(state.end(), loop.begin(), loop.end());
  state[0] = static_cast<double>(state.size());
  const int size = static_cast<int>(state.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state.data(), sizeof(double), state.size(), fp);
}

void FixRBCStream::restart(char *buffer)
{
  constexpr int head = 5;
  const auto numbers = reinterpret_cast<const double *>(buffer);
  placement->set_drawn(static_cast<std::int64_t>(numbers[1]));
  last_atom = static_cast<tagint>(numbers[2]);
  last_molecule = static_cast<tagint>(numbers[3]);
  const double *const loop = numbers + head + static_cast<std::size_t>(numbers[4]);
  remembered.assign(loop, numbers + static_cast<std::size_t>(numbers[0]));
  if (!ledger->restore({numbers + head, loop}))
    error->all(FLERR, "{}: the restart file is of one with another number of outlets than {}",
               style, outlets.size());
}
