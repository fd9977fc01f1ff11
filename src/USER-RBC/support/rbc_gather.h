#ifndef LMP_RBC_GATHER_H
#define LMP_RBC_GATHER_H

#include <mpi.h>

#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

/// Collective: the elements of all ranks of `world`, in the order of the ranks. Each may have
/// another number of them. They are sent as bytes, so that all ranks must have the same
/// representation, and those of all ranks must be less than 2^31 bytes.
template <typename Element>
std::vector<Element> gather_all(const std::vector<Element> &mine, MPI_Comm world)
{
  static_assert(std::is_trivially_copyable_v<Element>, "elements are sent as bytes");
  int ranks;
  MPI_Comm_size(world, &ranks);
  if (ranks == 1) return mine;
  const int bytes = static_cast<int>(mine.size() * sizeof(Element));
  std::vector<int> counts(ranks), begins(ranks);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int r = 1; r < ranks; ++r) begins[r] = begins[r - 1] + counts[r - 1];
  std::vector<Element> all((begins.back() + counts.back()) / sizeof(Element));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), begins.data(), MPI_BYTE,
                 world);
  return all;
}

/// Collective: the same on rank 0. The other ranks get nothing.
template <typename Element>
std::vector<Element> gather_on_first(const std::vector<Element> &mine, MPI_Comm world)
{
  static_assert(std::is_trivially_copyable_v<Element>, "elements are sent as bytes");
  int ranks, me;
  MPI_Comm_size(world, &ranks);
  MPI_Comm_rank(world, &me);
  const int bytes = static_cast<int>(mine.size() * sizeof(Element));
  std::vector<int> counts(ranks), begins(ranks);
  MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  for (int r = 1; r < ranks; ++r) begins[r] = begins[r - 1] + counts[r - 1];
  std::vector<Element> all(me == 0 ? (begins.back() + counts.back()) / sizeof(Element) : 0);
  MPI_Gatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), begins.data(), MPI_BYTE, 0,
              world);
  return all;
}

}    // namespace LAMMPS_NS

#endif
