#include "coupling/rbc_wall_group.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

namespace {

/// An image as seen from another one. Image flags begin anew after the last, and so do differences.
imageint image_from(imageint first, imageint image)
{
  imageint seen = 0;
  for (int shift : {0, IMGBITS, IMG2BITS})
    seen |= (((image >> shift) - (first >> shift) + IMGMAX) & IMGMASK) << shift;
  return seen;
}

}    // namespace

/* ---------------------------------------------------------------------- */

WallGroup::WallGroup(LAMMPS *lmp, std::string style, int groupbit, const Settings &settings) :
    Pointers(lmp), style_(std::move(style)), groupbit_(groupbit), settings_(settings)
{
}

WallGroup::~WallGroup()
{
  memory->destroy(forces_);
}

void WallGroup::grow(int nmax)
{
  memory->grow(forces_, nmax, static_cast<int>(NUMBERS), "rbc/wall:forces");
}

/* ---------------------------------------------------------------------- */

void WallGroup::check_variables() const
{
  for (const NumberOrVariable &component : settings_.velocity) component.check(lmp, "fix rbc/wall");
}

void WallGroup::start_run()
{
  evaluate();
  velocity_ = velocity_end_;
  displaced_ = {};
}

/* ---------------------------------------------------------------------- */

bool WallGroup::moves() const
{
  for (const NumberOrVariable &component : settings_.velocity)
    if (component.is_variable() || component.value(lmp) != 0) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void WallGroup::evaluate()
{
  bool varies = false;
  for (const NumberOrVariable &component : settings_.velocity)
    varies = varies || component.is_variable();
  if (velocity_known_ && !varies) return;
  velocity_known_ = true;
  if (varies) modify->clearstep_compute();
  for (int d = 0; d < 3; ++d) velocity_end_[d] = settings_.velocity[d].value(lmp);
  if (varies) modify->addstep_compute(update->ntimestep + 1);
  for (double component : velocity_end_)
    if (!std::isfinite(component))
      error->all(FLERR, "{}: a velocity is not a number at step {}", style_, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void WallGroup::begin_step(bool again)
{
  if (again)
    place(0);
  else
    velocity_start_ = velocity_end_;
  evaluate();
  velocity_ = velocity_start_;
  displaced_ = {};
}

void WallGroup::place(double fraction)
{
  std::array<double, 3> by;
  bool any = false;
  for (int d = 0; d < 3; ++d) {
    const double change = velocity_end_[d] - velocity_start_[d];
    velocity_[d] = fraction == 1 ? velocity_end_[d] : velocity_start_[d] + fraction * change;
    const double displacement =
        update->dt * (velocity_start_[d] + 0.5 * fraction * change) * fraction;
    by[d] = displacement - displaced_[d];
    displaced_[d] = displacement;
    any = any || by[d] != 0;
  }
  if (!any) return;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit_)
      for (int d = 0; d < 3; ++d) atom->x[i][d] += by[d];
  moved_ = true;
}

/* ----------------------------------------------------------------------
   torque does not depend on which box the wall is in: positions are unwrapped from one of its atoms
------------------------------------------------------------------------- */

std::array<double, 6> WallGroup::total() const
{
  imageint first = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit_) first = std::max(first, atom->image[i]);
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LMP_IMAGEINT, MPI_MAX, world);
  double centre[4] = {0, 0, 0, 0}, x[3];
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit_)) continue;
    domain->unmap(atom->x[i], image_from(first, atom->image[i]), x);
    for (int d = 0; d < 3; ++d) centre[d] += x[d];
    centre[3] += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, centre, 4, MPI_DOUBLE, MPI_SUM, world);

  std::array<double, 6> sums{};
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit_)) continue;
    domain->unmap(atom->x[i], image_from(first, atom->image[i]), x);
    double arm[3], f[3];
    for (int d = 0; d < 3; ++d) {
      arm[d] = x[d] - centre[d] / centre[3];
      f[d] = forces_[i][d];
      sums[d] += f[d];
    }
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, g = (d + 2) % 3;
      sums[3 + d] += arm[e] * f[g] - arm[g] * f[e];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 6, MPI_DOUBLE, MPI_SUM, world);
  return sums;
}
