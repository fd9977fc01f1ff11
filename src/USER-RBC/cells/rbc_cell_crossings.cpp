#include "cells/rbc_cell_crossings.h"

#include "atom.h"
#include "cells/rbc_cell_contact.h"
#include "cells/rbc_near_surfaces.h"
#include "comm.h"
#include "error.h"
#include "support/rbc_gather.h"
#include "update.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace LAMMPS_NS;

// Distance within which pairs of triangles are listed, over the longest edge that is allowed. A
// larger one makes longer lists that hold for more steps.

static constexpr double MARGIN = 0.6;

// How far atoms move relative to each other in a step, at most, over what each may have moved since
// the surfaces were built: by twice that in the step, in opposite directions, and sqrt(3) for how
// CrossingFinder measures it, less the flow that moves all. What goes further is reported.

static constexpr double FURTHEST = 7;

/* ---------------------------------------------------------------------- */

CellCrossings::CellCrossings(LAMMPS *lmp, std::string style, const NearSurfaces &surfaces,
                             std::function<bool(int, int)> touch) :
    Pointers(lmp),
    style_(std::move(style)), surfaces_(surfaces), touch_(std::move(touch))
{
}

/* ---------------------------------------------------------------------- */

bool CellCrossings::start_run(const CellContact &style, std::vector<const CellContact *> before)
{
  own_gap_ = style.own_gap();
  before_ = std::move(before);
  if (!tests_anything()) return false;
  retaken_ = 0;
  left_out_.clear();
  build_ = -1;
  learn_triangles();
  std::set<Cells> here;
  for (Pair pair : finder_.crossed(atom->x[0])) here.insert(cells(pair));
  std::vector<tagint> mine;
  for (const auto &[first, second] : here) mine.insert(mine.end(), {first, second});
  const std::vector<tagint> all = gather_all(mine, world);
  for (std::size_t n = 0; n < all.size(); n += 2) left_out_.insert({all[n], all[n + 1]});
  if (left_out_.empty()) return true;

  build_ = -1;    // the lists have them still
  if (comm->me != 0) return true;
  const auto [first, second] = *left_out_.begin();
  error->warning(FLERR,
                 "{}: surfaces of {} pair{} of cells cross at the start of the run, first those "
                 "of the cells with molecule IDs {} and {}; what passes through what there is not "
                 "tested in this run",
                 style_, left_out_.size(), left_out_.size() > 1 ? "s" : "", first, second);
  return true;
}

/* ---------------------------------------------------------------------- */

void CellCrossings::learn_triangles()
{
  if (build_ == surfaces_.builds()) return;
  build_ = surfaces_.builds();
  rbc::CrossingFinder::Scene scene;
  scene.triangles = &surfaces_.known_triangles();
  scene.places = &surfaces_.places();
  scene.points = atom->nlocal + atom->nghost;
  scene.owned = atom->nlocal;
  scene.margin = MARGIN * surfaces_.longest_edge();
  scene.furthest = FURTHEST * surfaces_.allowed_displacement();
  scene.own_surfaces = surfaces_.see_own_cells();
  scene.tested = [this](Pair pair) { return is_tested(pair); };
  scene.fans_tested = [this](Pair pair) { return surfaces_.fans_see(pair.first, pair.second); };
  finder_.build(std::move(scene));
}

bool CellCrossings::is_tested(Pair pair) const
{
  const auto &first = surfaces_.known_triangles()[pair.first].corner;
  const auto &second = surfaces_.known_triangles()[pair.second].corner;
  if (!left_out_.empty() && left_out_.count(cells(pair))) return false;
  if (atom->molecule[first[0]] != atom->molecule[second[0]])
    return tests_types(atom->type[first[0]], atom->type[second[0]]);
  return tests_itself(atom->type[first[0]]) && std::any_of(first.begin(), first.end(), [&](int i) {
           return surfaces_.sees_own(i, pair.second);
         });
}

bool CellCrossings::tests_types(int itype, int jtype) const
{
  return touch_(itype, jtype) &&
         std::none_of(before_.begin(), before_.end(), [=](const CellContact *style) {
           return style->contact_range(itype, jtype) > 0;
         });
}

/* ----------------------------------------------------------------------
   the nearer a cell sees itself, the more of it
------------------------------------------------------------------------- */

bool CellCrossings::tests_itself(int itype) const
{
  return own_gap_ > 0 && touch_(itype, itype) &&
         std::none_of(before_.begin(), before_.end(), [=](const CellContact *style) {
           return style->contact_range(itype, itype) > 0 && style->own_gap() > 0 &&
                  style->own_gap() <= own_gap_;
         });
}

bool CellCrossings::tests_anything() const
{
  for (int i = 1; i <= atom->ntypes; ++i) {
    if (tests_itself(i)) return true;
    for (int j = i; j <= atom->ntypes; ++j)
      if (tests_types(i, j)) return true;
  }
  return false;
}

CellCrossings::Cells CellCrossings::cells(Pair pair) const
{
  return std::minmax(atom->molecule[surfaces_.known_triangles()[pair.first].corner[0]],
                     atom->molecule[surfaces_.known_triangles()[pair.second].corner[0]]);
}

/* ---------------------------------------------------------------------- */

void CellCrossings::start_step()
{
  stopwatch_.start();
  learn_triangles();
  finder_.start(atom->x[0]);
  stopwatch_.stop();
}

void CellCrossings::report(CollectiveStop &stop)
{
  stopwatch_.start();
  comm->forward_comm();
  report_found(stop);
  stopwatch_.stop();
}

void CellCrossings::report_found(CollectiveStop &stop)
{
  learn_triangles();    // forces may have found surfaces anew within the step
  const auto [known, crossed] = finder_.find(atom->x[0]);
  if (!known && !surfaces_.report_moved(stop))
    stop.report(fmt::format("{}: surfaces of cells moved too far past each other to be tested for "
                            "crossing at step {}; raise the skin with the neighbor command, or "
                            "lower the timestep",
                            style_, update->ntimestep),
                Flaw::unseen_motion);
  if (!crossed) return;
  const auto [first, second] = cells(*crossed);
  const std::string which =
      first == second
          ? fmt::format("the cell with molecule ID {} passed through itself", first)
          : fmt::format("the cells with molecule IDs {} and {} passed through each other", first,
                        second);
  const double *const x = atom->x[surfaces_.known_triangles()[crossed->first].corner[0]];
  stop.report(fmt::format("{}: surfaces of {} near ({:.6g}, {:.6g}, {:.6g}) at step {}", style_,
                          which, x[0], x[1], x[2], update->ntimestep),
              Flaw::crossed);
}

/* ---------------------------------------------------------------------- */

void CellCrossings::tell()
{
  const bigint retaken = std::exchange(retaken_, 0);
  if (retaken > 0 && comm->me == 0)
    utils::logmesg(lmp,
                   "{}: {} step{} taken again because surfaces of cells passed through each "
                   "other\n",
                   style_, retaken, retaken > 1 ? "s were" : " was");
}
