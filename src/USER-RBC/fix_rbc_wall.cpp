#include "fix_rbc_wall.h"

#include "atom.h"
#include "coupling/rbc_kernel_words.h"
#include "coupling/rbc_rigid_walls.h"
#include "coupling/rbc_wall_spacing.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "group.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixRBCWall::FixRBCWall(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), fluid(narg > 3 ? arg[3] : ""),
    wall(lmp, fmt::format("Fix rbc/wall {}", id), groupbit, parse(narg, arg))
{
  vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extvector = 0;
  peratom_flag = 1;
  size_peratom_cols = 3;
  peratom_freq = 1;
  create_attribute = 1;

  FixRBCWall::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  for (int i = 0; i < atom->nlocal; ++i) FixRBCWall::set_arrays(i);
}

/* ---------------------------------------------------------------------- */

FixRBCWall::~FixRBCWall()
{
  if (modify->get_fix_by_id(id)) atom->delete_callback(id, Atom::GROW);
  if (FixRBCFluid *const fix = fluid_fix()) fix->driven_flow().drop_walls();
}

/* ---------------------------------------------------------------------- */

WallGroup::Settings FixRBCWall::parse(int narg, char **arg)
{
  WallGroup::Settings settings;
  Arguments args(lmp, "fix rbc/wall", narg, arg, 4);
  args.read({{"velocity", [&] { settings.velocity = args.vector(); }},
             {"kernel", [&] { settings.kernel = args.choice(kernel_words); }},
             {"sheets",
              [&] {
                settings.kind =
                    args.logical() ? fluid::MarkerKind::sheets : fluid::MarkerKind::points;
              }},
             {"tol", [&] { settings.tolerance = args.between(0, 1); }},
             {"maxiter", [&] { settings.max_solves = args.whole(1, MAXSMALLINT); }}});
  return settings;
}

/* ---------------------------------------------------------------------- */

int FixRBCWall::setmask()
{
  return POST_NEIGHBOR;
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::init()
{
  if (!fluid_fix())
    error->all(FLERR, "{}: there is no fix rbc/fluid with ID {}", wall.style(), fluid);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/wall cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/wall cannot be used with minimize");
  wall.check_variables();
  measured = -1;
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::setup_post_neighbor()
{
  wall.start_run();
  const bigint atoms = group->count(igroup);
  if (atoms != atoms_checked)
    warn_of_coarse_wall(lmp, wall, fluid_fix()->driven_flow().settings().cells);
  atoms_checked = atoms;
  post_neighbor();
}

void FixRBCWall::post_neighbor()
{
  wall.atoms_migrated();
}

/* ---------------------------------------------------------------------- */

FixRBCFluid *FixRBCWall::fluid_fix() const
{
  return dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid));
}

/* ----------------------------------------------------------------------
   of the fluid, of which this is one; null before a run has begun
------------------------------------------------------------------------- */

const RigidWalls *FixRBCWall::all_walls() const
{
  FixRBCFluid *const fix = fluid_fix();
  return fix ? fix->driven_flow().walls() : nullptr;
}

/* ----------------------------------------------------------------------
   1-3 force and 4-6 torque on the wall; of all walls: 7 worst slip relative to the largest speed,
   8 solves of the last evaluation, 9 solves per evaluation in this run
------------------------------------------------------------------------- */

double FixRBCWall::compute_vector(int n)
{
  const RigidWalls *const walls = all_walls();
  if (!walls) return 0;
  if (n == 6) return walls->slip();
  if (n == 7) return walls->last_solves();
  if (n == 8) return walls->mean_solves();
  if (measured != walls->evaluation()) total = wall.total();
  measured = walls->evaluation();
  return total[n];
}

/* ---------------------------------------------------------------------- */

double FixRBCWall::memory_usage()
{
  double bytes = static_cast<double>(atom->nmax) * WallGroup::NUMBERS * sizeof(double);
  if (all_walls() && all_walls()->first() == &wall)
    bytes += static_cast<double>(all_walls()->bytes());
  return bytes;
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::grow_arrays(int nmax)
{
  wall.grow(nmax);
  array_atom = wall.all_forces();
}

void FixRBCWall::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy_n(wall.forces(i), WallGroup::NUMBERS, wall.forces(j));
}

void FixRBCWall::set_arrays(int i)
{
  std::fill_n(wall.forces(i), WallGroup::NUMBERS, 0.0);
}

int FixRBCWall::pack_exchange(int i, double *buffer)
{
  std::copy_n(wall.forces(i), WallGroup::NUMBERS, buffer);
  return WallGroup::NUMBERS;
}

int FixRBCWall::unpack_exchange(int i, double *buffer)
{
  std::copy_n(buffer, WallGroup::NUMBERS, wall.forces(i));
  return WallGroup::NUMBERS;
}
