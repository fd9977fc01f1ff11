#include "fix_rbc_wall.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_rbc_fluid.h"
#include "memory.h"
#include "modify.h"
#include "rbc_rigid_walls.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixRBCWall::FixRBCWall(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix rbc/wall", error);
  fluid_id = arg[3];
  name = fmt::format("Fix rbc/wall {}", id);
  parse(narg, arg);

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
  memory->destroy(forces);
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::parse(int narg, char **arg)
{
  int iarg = 4;
  const auto need = [&](int n, const std::string &keyword) {
    if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "fix rbc/wall " + keyword, error);
  };
  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    if (keyword == "velocity") {
      need(3, keyword);
      for (int d = 0; d < 3; ++d) prescribed[d] = NumberOrVariable(lmp, arg[iarg + 1 + d]);
      iarg += 4;
      continue;
    }
    need(1, keyword);
    const char *const value = arg[iarg + 1];
    if (keyword == "kernel") {
      if (strcmp(value, "peskin4") == 0)
        kernel = fluid::KernelKind::peskin4;
      else if (strcmp(value, "roma3") == 0)
        kernel = fluid::KernelKind::roma3;
      else
        error->all(FLERR, iarg + 1, "Unknown fix rbc/wall kernel {}; allowed: peskin4, roma3",
                   value);
    } else if (keyword == "tol") {
      tolerance = utils::numeric(FLERR, value, false, lmp);
      if (!(tolerance > 0 && tolerance < 1))
        error->all(FLERR, iarg + 1, "Fix rbc/wall tol value {} must be between 0 and 1", value);
    } else if (keyword == "maxiter") {
      max_solves = utils::inumeric(FLERR, value, false, lmp);
      if (max_solves < 1)
        error->all(FLERR, iarg + 1, "Fix rbc/wall maxiter value {} must be > 0", value);
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/wall keyword {}; allowed: velocity, kernel, tol, maxiter",
                 keyword);
    iarg += 2;
  }
}

/* ---------------------------------------------------------------------- */

int FixRBCWall::setmask()
{
  return INITIAL_INTEGRATE | POST_NEIGHBOR;
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::init()
{
  fluid_fix = dynamic_cast<FixRBCFluid *>(modify->get_fix_by_id(fluid_id));
  if (!fluid_fix) error->all(FLERR, "{}: there is no fix rbc/fluid with ID {}", name, fluid_id);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/wall cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/wall cannot be used with minimize");
  for (NumberOrVariable &component : prescribed) component.check(lmp, "fix rbc/wall");
  measured = -1;
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::setup_post_neighbor()
{
  evaluate();
  velocity_now = velocity_end;
  displaced = {};
  post_neighbor();
}

void FixRBCWall::post_neighbor()
{
  if (RigidWalls *const walls = fluid_fix->rigid_walls()) walls->atoms_migrated();
}

/* ----------------------------------------------------------------------
   a fix rbc/ib places walls within the step
------------------------------------------------------------------------- */

void FixRBCWall::initial_integrate(int /*vflag*/)
{
  if (fluid_fix->is_driven()) return;
  begin_step(false);
  place(1);
}

/* ---------------------------------------------------------------------- */

bool FixRBCWall::moves() const
{
  for (const NumberOrVariable &component : prescribed)
    if (component.is_variable() || component.value(lmp) != 0) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::evaluate()
{
  const bool varies =
      prescribed[0].is_variable() || prescribed[1].is_variable() || prescribed[2].is_variable();
  if (velocity_known && !varies) return;
  velocity_known = true;
  if (varies) modify->clearstep_compute();
  for (int d = 0; d < 3; ++d) velocity_end[d] = prescribed[d].value(lmp);
  if (varies) modify->addstep_compute(update->ntimestep + 1);
  for (double component : velocity_end)
    if (!std::isfinite(component))
      error->all(FLERR, "{}: a velocity is not a number at step {}", name, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::begin_step(bool again)
{
  if (again)
    place(0);
  else
    velocity_start = velocity_end;
  evaluate();
  velocity_now = velocity_start;
  displaced = {};
}

/* ----------------------------------------------------------------------
   the velocity is linear in time within a step
------------------------------------------------------------------------- */

void FixRBCWall::place(double fraction)
{
  std::array<double, 3> by;
  bool any = false;
  for (int d = 0; d < 3; ++d) {
    const double change = velocity_end[d] - velocity_start[d];
    velocity_now[d] = fraction == 1 ? velocity_end[d] : velocity_start[d] + fraction * change;
    const double displacement =
        update->dt * (velocity_start[d] + 0.5 * fraction * change) * fraction;
    by[d] = displacement - displaced[d];
    displaced[d] = displacement;
    any = any || by[d] != 0;
  }
  if (!any) return;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (int d = 0; d < 3; ++d) atom->x[i][d] += by[d];
  fluid_fix->rigid_walls()->walls_moved();
}

/* ----------------------------------------------------------------------
   forces and torques of the fluid on the wall
------------------------------------------------------------------------- */

void FixRBCWall::measure()
{
  // about the mean place of the atoms
  double centre[4] = {0, 0, 0, 0}, x[3];
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    domain->unmap(atom->x[i], atom->image[i], x);
    for (int d = 0; d < 3; ++d) centre[d] += x[d];
    centre[3] += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, centre, 4, MPI_DOUBLE, MPI_SUM, world);
  std::fill_n(sums, 6, 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    domain->unmap(atom->x[i], atom->image[i], x);
    double arm[3], f[3];
    for (int d = 0; d < 3; ++d) {
      arm[d] = x[d] - centre[d] / centre[3];
      f[d] = forces[i][d];
      sums[d] += f[d];
    }
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, g = (d + 2) % 3;
      sums[3 + d] += arm[e] * f[g] - arm[g] * f[e];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, world);
}

/* ----------------------------------------------------------------------
   1-3 force and 4-6 torque on the wall; of all walls: 7 worst slip relative to the largest speed, 8 solves of the last
   evaluation, 9 solves per evaluation in this run
------------------------------------------------------------------------- */

double FixRBCWall::compute_vector(int n)
{
  const RigidWalls *const walls = fluid_fix ? fluid_fix->rigid_walls() : nullptr;
  if (!walls) return 0;
  if (n == 6) return walls->slip();
  if (n == 7) return walls->last_solves();
  if (n == 8) return walls->mean_solves();
  if (measured != walls->evaluation()) measure();
  measured = walls->evaluation();
  return sums[n];
}

/* ---------------------------------------------------------------------- */

double FixRBCWall::memory_usage()
{
  double bytes = static_cast<double>(atom->nmax) * NUMBERS * sizeof(double);
  if (fluid_fix && fluid_fix->rigid_walls() && fluid_fix->rigid_walls()->first() == this)
    bytes += static_cast<double>(fluid_fix->rigid_walls()->bytes());
  return bytes;
}

/* ---------------------------------------------------------------------- */

void FixRBCWall::grow_arrays(int nmax)
{
  memory->grow(forces, nmax, static_cast<int>(NUMBERS), "fix_rbc_wall:forces");
  array_atom = forces;
}

void FixRBCWall::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy_n(forces[i], NUMBERS, forces[j]);
}

void FixRBCWall::set_arrays(int i)
{
  std::fill_n(forces[i], NUMBERS, 0.0);
}

int FixRBCWall::pack_exchange(int i, double *buffer)
{
  std::copy_n(forces[i], NUMBERS, buffer);
  return NUMBERS;
}

int FixRBCWall::unpack_exchange(int i, double *buffer)
{
  std::copy_n(buffer, NUMBERS, forces[i]);
  return NUMBERS;
}
