#include "fluid/halo.h"

namespace fluid {

namespace {

/// A rank whose subdomain holds no centre of a cell may hold markers and needs their layers, too.
Box with_ghosts(const Grid &grid, const Box &brick, int width)
{
  if (brick.empty() && width <= Halo::plate_layers) return brick;
  Box box = brick;
  for (int d = 0; d < 3; ++d) {
    box.lo[d] -= width;
    box.hi[d] += width;
  }
  if (grid.plates) {
    box.lo[2] = std::max(box.lo[2], -Halo::plate_layers);
    box.hi[2] = std::min(box.hi[2], grid.cells[2] + Halo::plate_layers + 1);
  }
  return box;
}

/// Parts of `owner`'s brick and its periodic images that lie in `ghosted`, as seen by the ghost
/// cells' holder; the image at `shift` has its source at box - shift.
template <typename Visit>
void for_each_image(const Grid &grid, const Box &owner, const Box &ghosted, bool same_rank,
                    Visit visit)
{
  Index3 most{};
  for (int d = 0; d < 3; ++d) {
    if (d == 2 && grid.plates) continue;
    const int reach = std::max(-ghosted.lo[d], ghosted.hi[d] - grid.cells[d]);
    most[d] = std::max(0, (reach + grid.cells[d] - 1) / grid.cells[d]);
  }
  for (int sz = -most[2]; sz <= most[2]; ++sz)
    for (int sy = -most[1]; sy <= most[1]; ++sy)
      for (int sx = -most[0]; sx <= most[0]; ++sx) {
        if (same_rank && sx == 0 && sy == 0 && sz == 0) continue;
        const Index3 shift{sx * grid.cells[0], sy * grid.cells[1], sz * grid.cells[2]};
        const Box box = intersection(owner.shifted(shift), ghosted);
        if (!box.empty()) visit(box, shift);
      }
}

}    // namespace

Halo::Halo(const Grid &grid, const Decomposition &decomposition, int width) :
    box_(with_ghosts(grid, decomposition.mine(), width))
{
  const int me = decomposition.rank;
  std::vector<Transfer> sends, receives;
  for (int r = 0; r < decomposition.ranks(); ++r) {
    const Box &theirs = decomposition.bricks[r];
    for_each_image(grid, theirs, box_, r == me, [&](const Box &box, const Index3 &) {
      receives.push_back({r, box});
    });
    for_each_image(grid, decomposition.mine(), with_ghosts(grid, theirs, width), r == me,
                   [&](const Box &box, const Index3 &shift) {
                     sends.push_back({r, box.shifted({-shift[0], -shift[1], -shift[2]})});
                   });
  }
  exchange_ = Exchange<double>(decomposition.comm, HALO_TAG, sends, receives);
}

}    // namespace fluid
