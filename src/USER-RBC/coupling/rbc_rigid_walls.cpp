#include "coupling/rbc_rigid_walls.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void RigidWalls::connect(const std::vector<WallGroup *> &walls, bool free_mean)
{
  walls_ = walls;
  for (WallGroup *wall : walls_) {
    check_settings(*wall);
    check_atoms(*wall);
    wall->atoms_migrated();
  }
  fluid::RigidSurface::Settings settings = surface_.settings();
  if (settings.free_mean != free_mean) surface_is_set_ = false;
  if (surface_.kernel() != first()->settings().kernel) surface_is_set_ = false;
  if (settings.kind != first()->settings().kind) surface_is_set_ = false;
  settings.tolerance = first()->settings().tolerance;
  settings.max_solves = first()->settings().max_solves;
  settings.free_mean = free_mean;
  settings.kind = first()->settings().kind;
  surface_.set_settings(settings);
}

bool RigidWalls::has_atom(const WallGroup &wall, int i) const
{
  return atom->mask[i] & wall.groupbit();
}

void RigidWalls::check_settings(const WallGroup &wall) const
{
  const WallGroup::Settings &mine = wall.settings(), &firsts = first()->settings();
  if (mine.kernel != firsts.kernel || mine.kind != firsts.kind ||
      mine.tolerance != firsts.tolerance || mine.max_solves != firsts.max_solves)
    error->all(
        FLERR,
        "{}: kernel, sheets, tol and maxiter must be those of {}, which bounds the same fluid",
        wall.style(), first()->style());
}

void RigidWalls::check_atoms(const WallGroup &wall) const
{
  bigint atoms = 0;
  for (int i = 0; i < atom->nlocal; ++i) atoms += has_atom(wall, i);
  MPI_Allreduce(MPI_IN_PLACE, &atoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (atoms == 0) error->all(FLERR, "{}: its group has no atoms", wall.style());
  for (const WallGroup *other : walls_) {
    if (other == &wall) break;
    int shared = 0;
    for (int i = 0; i < atom->nlocal; ++i)
      if (has_atom(wall, i) && has_atom(*other, i)) shared = 1;
    MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, world);
    if (shared) error->all(FLERR, "{} and {} have atoms in common", wall.style(), other->style());
  }
}

/* ---------------------------------------------------------------------- */

bool RigidWalls::moves() const
{
  return std::any_of(walls_.begin(), walls_.end(),
                     [](const WallGroup *wall) { return wall->moves(); });
}

double RigidWalls::fastest() const
{
  double speed = 0;
  for (const WallGroup *wall : walls_) {
    const auto &v = wall->velocity();
    speed = std::max(speed, std::hypot(v[0], v[1], v[2]));
  }
  return speed;
}

std::string RigidWalls::names() const
{
  std::string list;
  for (const WallGroup *wall : walls_)
    list += (list.empty() ? "f" : ", f") + wall->style().substr(1);
  return list;
}

void RigidWalls::start_clock()
{
  surface_.shift_times(span_);
  span_ = 0;
  begun_ = false;
}

void RigidWalls::begin_step(bool again)
{
  if (!again) start_clock();
  begun_ = true;
  for (WallGroup *wall : walls_) wall->begin_step(again);
}

void RigidWalls::place(double fraction)
{
  for (WallGroup *wall : walls_) wall->place(fraction);
}

/* ----------------------------------------------------------------------
   Updates surface_ if wall atoms moved, or sets it up anew if they changed ranks. Preconditioner
   and directions stay valid as long as each rank holds the same atoms.
------------------------------------------------------------------------- */

void RigidWalls::find_markers(const fluid::Flow &flow)
{
  const Change change = find_change();
  if (change == Change::places) surface_.move(position_.data());
  if (change == Change::atoms) set_markers(flow);
}

RigidWalls::Change RigidWalls::find_change()
{
  bool migrated = false, moved = false;
  for (WallGroup *wall : walls_) {
    migrated = wall->take_migrated() || migrated;
    moved = wall->take_moved() || moved;
  }
  Change change = surface_is_set_ ? (moved ? Change::places : Change::none) : Change::atoms;
  if (migrated) {
    collect_markers();
    if (!take_tags()) change = Change::atoms;
  }
  if (change == Change::atoms || migrated || moved) {
    position_.resize(3 * markers_.size());
    for (std::size_t n = 0; n < markers_.size(); ++n)
      for (int d = 0; d < 3; ++d) {
        const double x = atom->x[markers_[n].atom][d];
        if (position_[3 * n + d] != x) change = std::max(change, Change::places);
        position_[3 * n + d] = x;
      }
  }
  if (migrated && comm->nprocs > 1) {
    int code = static_cast<int>(change);
    MPI_Allreduce(MPI_IN_PLACE, &code, 1, MPI_INT, MPI_MAX, world);
    change = static_cast<Change>(code);
  }
  return change;
}

void RigidWalls::collect_markers()
{
  markers_.clear();
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (int i = 0; i < atom->nlocal; ++i)
      if (has_atom(*walls_[w], i)) markers_.push_back({atom->tag[i], i, static_cast<int>(w)});
  std::sort(markers_.begin(), markers_.end(),
            [](const Marker &a, const Marker &b) { return a.tag < b.tag; });
}

/* ----------------------------------------------------------------------
   Stores the IDs and walls of markers_; returns whether they are the same as at the last call.
------------------------------------------------------------------------- */

bool RigidWalls::take_tags()
{
  const std::size_t count = markers_.size();
  bool same = tags_.size() == count;
  for (std::size_t n = 0; same && n < count; ++n)
    same = tags_[n] == markers_[n].tag && body_[n] == markers_[n].wall;
  tags_.resize(count);
  body_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    tags_[n] = markers_[n].tag;
    body_[n] = markers_[n].wall;
  }
  return same;
}

void RigidWalls::set_markers(const fluid::Flow &flow)
{
  if (set_remembered(flow)) return;
  const auto times = surface_.times();
  surface_.set_markers(flow, first()->settings().kernel, static_cast<int>(markers_.size()),
                       position_.data(), body_.data());
  if (surface_is_set_) surface_.set_times(times);
  surface_is_set_ = true;
  take_forces();
}

/* ----------------------------------------------------------------------
   of the atoms, to the surface
------------------------------------------------------------------------- */

void RigidWalls::take_forces()
{
  for (std::size_t n = 0; n < markers_.size(); ++n) {
    const double *const forces = walls_[markers_[n].wall]->forces(markers_[n].atom);
    for (int d = 0; d < 3; ++d) {
      surface_.force()[3 * n + d] = -forces[d] * force->ftm2v;
      surface_.earlier_force()[3 * n + d] = -forces[3 + d] * force->ftm2v;
    }
  }
}

/* ---------------------------------------------------------------------- */

void RigidWalls::spread(fluid::Flow &flow, double fraction, const std::array<double, 3> &others,
                        CollectiveStop &stop)
{
  stopwatch_.start();
  find_markers(flow);
  for (std::size_t n = 0; n < markers_.size(); ++n)
    std::copy_n(walls_[markers_[n].wall]->velocity().data(), 3, surface_.target() + 3 * n);
  if (begun_) span_ = update->dt;
  const int outside = surface_.spread(flow, fraction * span_, others);
  stopwatch_.stop();
  if (outside < 0) return;
  const Marker &lost = markers_[outside];
  const double *const x = atom->x[lost.atom];
  stop.report(
      fmt::format(
          "{}: wall atom with ID {} left the fluid its MPI task holds (reneighboring too rare, see "
          "neigh_modify) or lies beyond a plate at step {}: ({:.6g}, {:.6g}, {:.6g})",
          walls_[lost.wall]->style(), lost.tag, update->ntimestep, x[0], x[1], x[2]),
      Flaw::left_fluid);
}

/* ---------------------------------------------------------------------- */

void RigidWalls::enforce(fluid::Flow &flow)
{
  stopwatch_.start();
  outcome_ = surface_.enforce(flow);
  ++evaluations_;
  solves_ += outcome_.solves;
  if (!outcome_.converged) ++unconverged_;
  give_forces();
  for (const Marker &marker : markers_)
    std::copy_n(walls_[marker.wall]->velocity().data(), 3, atom->v[marker.atom]);
  stopwatch_.stop();
}

/* ----------------------------------------------------------------------
   of the surface, to the atoms
------------------------------------------------------------------------- */

void RigidWalls::give_forces()
{
  for (std::size_t n = 0; n < markers_.size(); ++n) {
    double *const forces = walls_[markers_[n].wall]->forces(markers_[n].atom);
    for (int d = 0; d < 3; ++d) {
      forces[d] = -surface_.force()[3 * n + d] / force->ftm2v;
      forces[3 + d] = -surface_.earlier_force()[3 * n + d] / force->ftm2v;
    }
  }
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
  stopwatch_.reset();
}

void RigidWalls::warn() const
{
  if (unconverged_ > 0)
    error->warning(FLERR, "{} reached its maxiter of {} in {} evaluations", first()->style(),
                   first()->settings().max_solves, unconverged_);
  const bool none_since = evaluations_ == first_evaluation_;
  if (none_since && !outcome_.converged && outcome_.solves >= first()->settings().max_solves)
    error->warning(FLERR,
                   "{} reached its maxiter of {} at the start of the run, with a slip of {:.3g}",
                   first()->style(), first()->settings().max_solves, outcome_.slip);
}

std::size_t RigidWalls::bytes() const
{
  return surface_.bytes() + markers_.capacity() * sizeof(Marker) +
         tags_.capacity() * sizeof(tagint) + body_.capacity() * sizeof(int) +
         (position_.capacity() + remembered_.capacity()) * sizeof(double);
}
