// To be preloaded: counts the messages that a program sends. Rank 0 writes a line for each kind of
// message to the file that COUNT_MESSAGES names: the kind, messages and bytes in the mean over the
// ranks, and the most messages and bytes of any rank. Of a collective call the bytes count that the
// rank gets, where these are more than it gives.

#include <mpi.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace {

enum Kind { LAMMPS_OWN, HALO, TRANSPOSES, SHARED_CELLS, COLLECTIVE, KINDS };
constexpr const char *NAMES[KINDS] = {"lammps", "halo", "transposes", "shared_cells", "collective"};

std::array<double, 2 * KINDS> counted{};    // messages and bytes of each kind

Kind kind_of(int tag)
{
  switch (tag) {
    case 2001:
      return HALO;
    case 2002:
    case 2003:
      return TRANSPOSES;
    case 2101:
      return SHARED_CELLS;
    default:
      return LAMMPS_OWN;
  }
}

void count(Kind kind, int number, MPI_Datatype type)
{
  int size;
  PMPI_Type_size(type, &size);
  counted[2 * kind] += 1;
  counted[2 * kind + 1] += static_cast<double>(number) * size;
}

int size_of(MPI_Comm comm)
{
  int ranks;
  PMPI_Comm_size(comm, &ranks);
  return ranks;
}

}    // namespace

extern "C" {

int MPI_Send(const void *from, int number, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  count(kind_of(tag), number, type);
  return PMPI_Send(from, number, type, to, tag, comm);
}

int MPI_Isend(const void *from, int number, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request *request)
{
  count(kind_of(tag), number, type);
  return PMPI_Isend(from, number, type, to, tag, comm, request);
}

int MPI_Sendrecv(const void *from, int number, MPI_Datatype type, int to, int tag, void *into,
                 int most, MPI_Datatype into_type, int source, int into_tag, MPI_Comm comm,
                 MPI_Status *status)
{
  count(kind_of(tag), number, type);
  return PMPI_Sendrecv(from, number, type, to, tag, into, most, into_type, source, into_tag, comm,
                       status);
}

int MPI_Allreduce(const void *from, void *into, int number, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm)
{
  count(COLLECTIVE, number, type);
  return PMPI_Allreduce(from, into, number, type, op, comm);
}

int MPI_Allgather(const void *from, int number, MPI_Datatype type, void *into, int most,
                  MPI_Datatype into_type, MPI_Comm comm)
{
  count(COLLECTIVE, most * size_of(comm), into_type);
  return PMPI_Allgather(from, number, type, into, most, into_type, comm);
}

int MPI_Allgatherv(const void *from, int number, MPI_Datatype type, void *into, const int *most,
                   const int *begins, MPI_Datatype into_type, MPI_Comm comm)
{
  count(COLLECTIVE, std::accumulate(most, most + size_of(comm), 0), into_type);
  return PMPI_Allgatherv(from, number, type, into, most, begins, into_type, comm);
}

int MPI_Reduce(const void *from, void *into, int number, MPI_Datatype type, MPI_Op op, int root,
               MPI_Comm comm)
{
  count(COLLECTIVE, number, type);
  return PMPI_Reduce(from, into, number, type, op, root, comm);
}

int MPI_Reduce_scatter(const void *from, void *into, const int *numbers, MPI_Datatype type,
                       MPI_Op op, MPI_Comm comm)
{
  count(COLLECTIVE, size_of(comm), type);
  return PMPI_Reduce_scatter(from, into, numbers, type, op, comm);
}

int MPI_Bcast(void *data, int number, MPI_Datatype type, int root, MPI_Comm comm)
{
  count(COLLECTIVE, number, type);
  return PMPI_Bcast(data, number, type, root, comm);
}

int MPI_Finalize()
{
  int rank, ranks;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  PMPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::array<double, 2 * KINDS> sum{}, most{};
  PMPI_Reduce(counted.data(), sum.data(), 2 * KINDS, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  PMPI_Reduce(counted.data(), most.data(), 2 * KINDS, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
  const char *const path = std::getenv("COUNT_MESSAGES");
  std::FILE *const file = rank == 0 && path ? std::fopen(path, "w") : nullptr;
  if (file) {
    for (int k = 0; k < KINDS; ++k)
      std::fprintf(file, "%s %.17g %.17g %.17g %.17g\n", NAMES[k], sum[2 * k] / ranks,
                   sum[2 * k + 1] / ranks, most[2 * k], most[2 * k + 1]);
    std::fclose(file);
  }
  return PMPI_Finalize();
}
}
