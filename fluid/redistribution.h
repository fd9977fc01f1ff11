#pragma once

#include "fluid/exchange.h"

namespace fluid {

/// Exchange from one set of bricks (rank r owns from[r]) to another (to[r]).
template <typename T>
Exchange<T> exchange_between(MPI_Comm comm, const std::vector<Box> &from,
                             const std::vector<Box> &to)
{
  int me;
  MPI_Comm_rank(comm, &me);
  return {comm, REDISTRIBUTION_TAG, overlaps(from[me], to), overlaps(to[me], from)};
}

/// Moves a distributed array from one set of bricks (rank r owns from[r]) to another (to[r]).
/// Moves nothing, and needs no memory, where every rank's brick is the same in both.
class Redistribution {
 public:
  Redistribution() = default;
  Redistribution(MPI_Comm comm, const std::vector<Box> &from, const std::vector<Box> &to) :
      identity_(from == to)
  {
    if (!identity_) exchange_ = exchange_between<double>(comm, from, to);
  }

  bool identity() const { return identity_; }

  template <std::size_t N>
  void forward(const std::array<View<double>, N> &from, const std::array<View<double>, N> &to)
  {
    exchange_.copy(from, to);
  }
  template <std::size_t N>
  void backward(const std::array<View<double>, N> &from, const std::array<View<double>, N> &to)
  {
    exchange_.copy_back(from, to);
  }

  const Traffic &traffic() const { return exchange_.traffic(); }
  std::size_t bytes() const { return exchange_.bytes(); }

 private:
  bool identity_ = true;
  Exchange<double> exchange_;
};

}    // namespace fluid
