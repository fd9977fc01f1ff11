#include "rbc_rigid_walls.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_rbc_wall.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

bool RigidWalls::connect(const std::string &fluid_id, bool free_mean)
{
  walls_.clear();
  for (Fix *fix : modify->get_fix_by_style("^rbc/wall$")) {
    const auto wall = dynamic_cast<FixRBCWall *>(fix);
    if (wall->fluid() == fluid_id) walls_.push_back(wall);
  }
  if (walls_.empty()) return false;
  for (FixRBCWall *wall : walls_) {
    if (wall->kernel != walls_[0]->kernel || wall->tolerance != walls_[0]->tolerance ||
        wall->max_solves != walls_[0]->max_solves)
      error->all(FLERR,
                 "{}: kernel, tol and maxiter must be those of {}, which bounds the same fluid",
                 wall->style_name(), walls_[0]->style_name());
    bigint atoms = 0;
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & wall->groupbit)) continue;
      ++atoms;
    }
    MPI_Allreduce(MPI_IN_PLACE, &atoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    if (atoms == 0) error->all(FLERR, "{}: its group has no atoms", wall->style_name());
    for (const FixRBCWall *other : walls_) {
      if (other == wall) break;
      int shared = 0;
      for (int i = 0; i < atom->nlocal; ++i)
        if ((atom->mask[i] & wall->groupbit) && (atom->mask[i] & other->groupbit)) shared = 1;
      MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, world);
      if (shared)
        error->all(FLERR, "{} and {} have atoms in common", wall->style_name(),
                   other->style_name());
    }
  }
  surface_.tolerance = walls_[0]->tolerance;
  surface_.max_solves = walls_[0]->max_solves;
  if (surface_.free_mean != free_mean) known_ = false;
  surface_.free_mean = free_mean;
  migrated_ = true;
  return true;
}

/* ---------------------------------------------------------------------- */

bool RigidWalls::moves() const
{
  return std::any_of(walls_.begin(), walls_.end(),
                     [](const FixRBCWall *wall) { return wall->moves(); });
}

void RigidWalls::begin_step(bool again)
{
  for (FixRBCWall *wall : walls_) wall->begin_step(again);
}

void RigidWalls::place(double fraction)
{
  for (FixRBCWall *wall : walls_) wall->place(fraction);
}

/* ----------------------------------------------------------------------
   what is known of the markers stays valid as long as all tasks hold the same atoms
------------------------------------------------------------------------- */

void RigidWalls::find_markers(const fluid::Flow &flow)
{
  if (migrated_) {
    markers_.clear();
    for (std::size_t w = 0; w < walls_.size(); ++w)
      for (int i = 0; i < atom->nlocal; ++i)
        if (atom->mask[i] & walls_[w]->groupbit)
          markers_.push_back({atom->tag[i], i, static_cast<int>(w)});
    std::sort(markers_.begin(), markers_.end(),
              [](const Marker &a, const Marker &b) { return a.tag < b.tag; });
  }

  // 2: other atoms, 1: the same elsewhere, 0: nothing has changed
  int change = known_ ? (moved_ ? 1 : 0) : 2;
  const bool check_places = migrated_;
  if (migrated_) {
    const std::size_t count = markers_.size();
    bool same = tags_.size() == count;
    for (std::size_t n = 0; same && n < count; ++n)
      same = tags_[n] == markers_[n].tag && body_[n] == markers_[n].wall;
    if (!same) change = 2;
    tags_.resize(count);
    body_.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
      tags_[n] = markers_[n].tag;
      body_[n] = markers_[n].wall;
    }
  }
  if (change == 2 || check_places || moved_) {
    position_.resize(3 * markers_.size());
    for (std::size_t n = 0; n < markers_.size(); ++n)
      for (int d = 0; d < 3; ++d) {
        const double x = atom->x[markers_[n].atom][d];
        if (position_[3 * n + d] != x) change = std::max(change, 1);
        position_[3 * n + d] = x;
      }
  }
  if (check_places && comm->nprocs > 1)
    MPI_Allreduce(MPI_IN_PLACE, &change, 1, MPI_INT, MPI_MAX, world);
  migrated_ = moved_ = false;
  if (change == 0) return;
  if (change == 1) {
    surface_.move(position_.data());
    return;
  }

  const auto times = surface_.times;
  surface_.set_markers(flow, walls_[0]->kernel, static_cast<int>(markers_.size()), position_.data(),
                       body_.data());
  if (known_) surface_.times = times;
  known_ = true;
  for (std::size_t n = 0; n < markers_.size(); ++n) {
    const double *const forces = walls_[markers_[n].wall]->forces[markers_[n].atom];
    for (int d = 0; d < 3; ++d) {
      surface_.force()[3 * n + d] = -forces[d] * force->ftm2v;
      surface_.earlier_force()[3 * n + d] = -forces[3 + d] * force->ftm2v;
    }
  }
}

/* ---------------------------------------------------------------------- */

void RigidWalls::spread(fluid::Flow &flow, double time, const fluid::Vec3 &others,
                        CollectiveStop &stop)
{
  stopwatch.start();
  find_markers(flow);
  for (std::size_t n = 0; n < markers_.size(); ++n)
    std::copy_n(walls_[markers_[n].wall]->velocity().data(), 3, surface_.target() + 3 * n);
  const int outside = surface_.spread(flow, time, others);
  stopwatch.stop();
  if (outside < 0) return;
  const Marker &lost = markers_[outside];
  const double *const x = atom->x[lost.atom];
  stop.report(fmt::format(
      "{}: wall atom with ID {} left the fluid its MPI task holds (reneighboring too rare, see "
      "neigh_modify) or lies beyond a plate at step {}: ({:.6g}, {:.6g}, {:.6g})",
      walls_[lost.wall]->style_name(), lost.tag, update->ntimestep, x[0], x[1], x[2]));
}

/* ---------------------------------------------------------------------- */

void RigidWalls::enforce(fluid::Flow &flow)
{
  stopwatch.start();
  outcome_ = surface_.enforce(flow);
  ++evaluations_;
  solves_ += outcome_.solves;
  if (!outcome_.converged) ++unconverged_;
  for (std::size_t n = 0; n < markers_.size(); ++n) {
    const FixRBCWall *const wall = walls_[markers_[n].wall];
    double *const forces = wall->forces[markers_[n].atom];
    for (int d = 0; d < 3; ++d) {
      forces[d] = -surface_.force()[3 * n + d] / force->ftm2v;
      forces[3 + d] = -surface_.earlier_force()[3 * n + d] / force->ftm2v;
    }
    std::copy_n(wall->velocity().data(), 3, atom->v[markers_[n].atom]);
  }
  stopwatch.stop();
}

/* ---------------------------------------------------------------------- */

double RigidWalls::mean_solves() const
{
  const bigint evaluations = evaluations_ - first_evaluation_;
  return evaluations > 0 ? static_cast<double>(solves_) / static_cast<double>(evaluations) : 0;
}

void RigidWalls::reset_counts()
{
  first_evaluation_ = evaluations_;
  solves_ = unconverged_ = 0;
  stopwatch.reset();
}

void RigidWalls::warn() const
{
  if (unconverged_ > 0)
    error->warning(FLERR, "{} reached its maxiter of {} in {} evaluations", walls_[0]->style_name(),
                   walls_[0]->max_solves, unconverged_);
}

std::size_t RigidWalls::bytes() const
{
  return surface_.bytes() + markers_.capacity() * sizeof(Marker) +
         tags_.capacity() * sizeof(tagint) + body_.capacity() * sizeof(int) +
         position_.capacity() * sizeof(double);
}
