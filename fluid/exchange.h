#pragma once

#include "fluid/field.h"
#include "fluid/message_tags.h"

#include <mpi.h>
#include <vector>

namespace fluid {

/// A box of the local array that goes to, or comes from, a rank.
struct Transfer {
  int rank;
  Box box;
};

/// Parts of `mine` that lie in the boxes of the ranks. `theirs` has one box for each rank; empty
/// parts are left out.
inline std::vector<Transfer> overlaps(const Box &mine, const std::vector<Box> &theirs)
{
  std::vector<Transfer> parts;
  for (int r = 0; r < static_cast<int>(theirs.size()); ++r) {
    const Box box = intersection(mine, theirs[r]);
    if (!box.empty()) parts.push_back({r, box});
  }
  return parts;
}

/// Messages and bytes that this rank has sent to other ranks since construction.
struct Traffic {
  long messages = 0;
  long bytes = 0;
};

/// Moves boxes between arrays of different ranks with one message a pair of ranks, whatever the
/// number of boxes and of components. The n-th box that rank a sends to rank b lands in the n-th
/// box that b receives from a; transfers of a rank to itself are copied.
template <typename T> class Exchange {
 public:
  static constexpr int max_components = 3;

  Exchange() = default;
  Exchange(MPI_Comm comm, MessageTag tag, const std::vector<Transfer> &sends,
           const std::vector<Transfer> &receives);

  /// Overwrites the receiving boxes of `to` with the sending boxes of `from`.
  template <std::size_t N>
  void copy(const std::array<View<T>, N> &from, const std::array<View<T>, N> &to)
  {
    run(from.data(), to.data(), N, sends_, receives_, false);
  }

  /// The way back: overwrites the sending boxes of `to` with the receiving boxes of `from`.
  template <std::size_t N>
  void copy_back(const std::array<View<T>, N> &from, const std::array<View<T>, N> &to)
  {
    run(from.data(), to.data(), N, receives_, sends_, false);
  }

  /// The transpose of copy: adds what stands in the receiving boxes of `from` to the sending boxes
  /// of `to`.
  template <std::size_t N>
  void accumulate(const std::array<View<T>, N> &from, const std::array<View<T>, N> &to)
  {
    run(from.data(), to.data(), N, receives_, sends_, true);
  }

  const Traffic &traffic() const { return traffic_; }
  std::size_t bytes() const { return outgoing_.bytes() + incoming_.bytes(); }

 private:
  struct Peer {
    int rank;
    std::vector<Box> boxes;
    std::size_t size = 0;
  };
  struct Side {
    std::vector<Peer> peers;
    std::vector<Box> self;
    std::size_t size = 0;
  };

  void run(const View<T> *from, const View<T> *to, int components, const Side &out, const Side &in,
           bool add);
  static Side sorted(int me, int ranks, const std::vector<Transfer> &transfers);

  MPI_Comm comm_ = MPI_COMM_NULL;
  MessageTag tag_ = HALO_TAG;
  Side sends_, receives_;
  Buffer<T> outgoing_, incoming_;
  std::vector<MPI_Request> requests_;
  Traffic traffic_;
};

}    // namespace fluid
