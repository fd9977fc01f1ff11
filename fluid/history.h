#pragma once

#include "fluid/grid.h"
#include "fluid/redistribution.h"

namespace fluid {

/// Moves distributed fields from one set of bricks to another. Collective.
template <typename T, std::size_t N>
void move(MPI_Comm comm, const std::vector<Box> &from_bricks, const std::array<View<T>, N> &from,
          const std::vector<Box> &to_bricks, const std::array<View<T>, N> &to)
{
  exchange_between<T>(comm, from_bricks, to_bricks).copy(from, to);
}

/// The fields of the whole domain, one after the other, on rank 0; nothing elsewhere. Collective.
template <typename T, int N>
Components<T, N> gather(MPI_Comm comm, const std::vector<Box> &bricks, const Box &domain,
                        const Components<T, N> &fields)
{
  int me;
  MPI_Comm_rank(comm, &me);
  std::vector<Box> gathered(bricks.size());
  gathered[0] = domain;
  Components<T, N> whole(gathered[me]);
  move(comm, bricks, fields.views(), gathered, whole.views());
  return whole;
}

/// Reads this rank's brick from the fields of the whole domain.
template <typename T, int N>
void cut_out(const Box &brick, const Box &domain, const T *whole, const Components<T, N> &fields)
{
  for (int c = 0; c < N; ++c)
    for (int k = brick.lo[2]; k < brick.hi[2]; ++k)
      for (int j = brick.lo[1]; j < brick.hi[1]; ++j)
        std::copy_n(whole + c * domain.size() + domain.offset(brick.lo[0], j, k), brick.extent(0),
                    &fields[c](brick.lo[0], j, k));
}

}    // namespace fluid
