#include "cells/rbc_shared_sums.h"

#include "comm.h"
#include "memory.h"

#include <algorithm>
#include <tuple>
#include <utility>

using namespace LAMMPS_NS;

// of messages; LAMMPS's own are below

static constexpr int TAG = 2101;

// The rank that introduces those which have parts of a cell is found from the number of the cell.
// Messages go straight to it, not to all ranks.

static constexpr int IRREGULAR = 0;
static constexpr int OUT_IS_NEW = 2;

void SharedSums::find_partners(std::vector<Part> parts)
{
  partners_.clear();
  places_.clear();
  any_ = false;
  if (comm->nprocs == 1) return;

  std::sort(parts.begin(), parts.end(),
            [](const Part &a, const Part &b) { return a.cell < b.cell; });
  for (const Part &part : parts) places_.push_back(part.place);
  std::vector<Holder> others = find_others(parts);
  std::sort(others.begin(), others.end(), [](const Holder &a, const Holder &b) {
    return std::tie(a.rank, a.cell) < std::tie(b.rank, b.cell);
  });
  for (const Holder &other : others) {
    if (partners_.empty() || partners_.back().rank != other.rank)
      partners_.push_back({other.rank, {}});
    const auto part = std::lower_bound(parts.begin(), parts.end(), other.cell,
                                       [](const Part &a, int cell) { return a.cell < cell; });
    partners_.back().places.push_back(part->place);
  }
  requests_.resize(2 * partners_.size());
  int shares = !partners_.empty();
  MPI_Allreduce(MPI_IN_PLACE, &shares, 1, MPI_INT, MPI_MAX, world);
  any_ = shares != 0;
}

/* ----------------------------------------------------------------------
   the other ranks that have a part of each of these cells
------------------------------------------------------------------------- */

std::vector<SharedSums::Holder> SharedSums::find_others(const std::vector<Part> &parts)
{
  std::vector<Holder> mine;
  std::vector<int> ranks;
  for (const Part &part : parts) {
    mine.push_back({part.cell, comm->me});
    ranks.push_back(part.cell % comm->nprocs);
  }
  char *found = nullptr;
  const int count = comm->rendezvous(IRREGULAR, static_cast<int>(mine.size()),
                                     reinterpret_cast<char *>(mine.data()), sizeof(Holder), 0,
                                     ranks.data(), introduce, 0, found, sizeof(Holder), this);
  const auto *const others = reinterpret_cast<const Holder *>(found);
  std::vector<Holder> all(others, others + count);
  memory->sfree(found);
  return all;
}

/* ----------------------------------------------------------------------
   tells each of the ranks that have a part of a cell of the others
------------------------------------------------------------------------- */

int SharedSums::introduce(int count, char *in, int &flag, int *&ranks, char *&out, void *self)
{
  auto *const holders = reinterpret_cast<Holder *>(in);
  std::sort(holders, holders + count, [](const Holder &a, const Holder &b) {
    return std::tie(a.cell, a.rank) < std::tie(b.cell, b.rank);
  });
  std::vector<std::pair<int, Holder>> told;
  for (int first = 0, last; first < count; first = last) {
    for (last = first; last < count && holders[last].cell == holders[first].cell;) ++last;
    for (int n = first; n < last; ++n)
      for (int other = first; other < last; ++other)
        if (other != n) told.emplace_back(holders[n].rank, holders[other]);
  }
  Memory *const memory = static_cast<SharedSums *>(self)->memory;
  memory->create(ranks, static_cast<int>(told.size()), "rbc/membrane:ranks");
  out = static_cast<char *>(memory->smalloc(told.size() * sizeof(Holder), "rbc/membrane:parts"));
  for (std::size_t n = 0; n < told.size(); ++n) {
    ranks[n] = told[n].first;
    reinterpret_cast<Holder *>(out)[n] = told[n].second;
  }
  flag = OUT_IS_NEW;
  return static_cast<int>(told.size());
}

/* ----------------------------------------------------------------------
   all ranks add the parts of a cell in ascending order of rank
------------------------------------------------------------------------- */

void SharedSums::sum(double *values, int width)
{
  if (partners_.empty()) return;
  exchange(values, width);
  own_.clear();
  for (int place : places_) {
    double *const at = values + std::size_t(place) * width;
    own_.insert(own_.end(), at, at + width);
    std::fill_n(at, width, 0.0);
  }
  const auto add = [&](const std::vector<int> &places, const double *from) {
    for (int place : places)
      for (int n = 0; n < width; ++n) values[std::size_t(place) * width + n] += *from++;
    return from;
  };
  const double *from = received_.data();
  auto partner = partners_.begin();
  for (; partner != partners_.end() && partner->rank < comm->me; ++partner)
    from = add(partner->places, from);
  add(places_, own_.data());
  for (; partner != partners_.end(); ++partner) from = add(partner->places, from);
}

void SharedSums::exchange(const double *values, int width)
{
  std::size_t count = 0;
  for (const Partner &partner : partners_) count += partner.places.size() * width;
  sent_.resize(count);
  received_.resize(count);
  double *send = sent_.data(), *receive = received_.data();
  MPI_Request *request = requests_.data();
  for (const auto &[rank, places] : partners_) {
    const int numbers = static_cast<int>(places.size()) * width;
    MPI_Irecv(receive, numbers, MPI_DOUBLE, rank, TAG, world, request++);
    double *at = send;
    for (int place : places) at = std::copy_n(values + std::size_t(place) * width, width, at);
    MPI_Isend(send, numbers, MPI_DOUBLE, rank, TAG, world, request++);
    receive += numbers;
    send += numbers;
  }
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}
