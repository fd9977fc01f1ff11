#include "fluid/exchange.h"

#include <complex>

namespace fluid {

namespace {

MPI_Datatype mpi_type(double)
{
  return MPI_DOUBLE;
}
MPI_Datatype mpi_type(std::complex<double>)
{
  return MPI_C_DOUBLE_COMPLEX;
}

template <typename T, typename Row> void for_each_row(const View<T> &view, const Box &box, Row row)
{
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j) row(&view(box.lo[0], j, k));
}

template <typename T> T *pack(const View<T> &view, const Box &box, T *buffer)
{
  const int n = box.extent(0);
  for_each_row(view, box, [&](const T *row) { buffer = std::copy_n(row, n, buffer); });
  return buffer;
}

template <typename T>
const T *unpack(const View<T> &view, const Box &box, const T *buffer, bool add)
{
  const int n = box.extent(0);
  for_each_row(view, box, [&](T *row) {
    if (add)
      for (int i = 0; i < n; ++i) row[i] += buffer[i];
    else
      std::copy_n(buffer, n, row);
    buffer += n;
  });
  return buffer;
}

template <typename T>
void transfer(const View<T> &from, const Box &source, const View<T> &to, const Box &target,
              bool add)
{
  const int n = source.extent(0);
  for (int k = 0; k < source.extent(2); ++k)
    for (int j = 0; j < source.extent(1); ++j) {
      const T *in = &from(source.lo[0], source.lo[1] + j, source.lo[2] + k);
      T *out = &to(target.lo[0], target.lo[1] + j, target.lo[2] + k);
      if (add)
        for (int i = 0; i < n; ++i) out[i] += in[i];
      else
        std::copy_n(in, n, out);
    }
}

}    // namespace

template <typename T>
typename Exchange<T>::Side Exchange<T>::sorted(int me, int ranks,
                                               const std::vector<Transfer> &transfers)
{
  std::vector<Peer> all(ranks);
  Side side;
  for (const auto &[rank, box] : transfers) {
    if (box.empty()) continue;
    if (rank == me) {
      side.self.push_back(box);
      continue;
    }
    all[rank].rank = rank;
    all[rank].boxes.push_back(box);
    all[rank].size += box.size();
    side.size += box.size();
  }
  for (auto &peer : all)
    if (!peer.boxes.empty()) side.peers.push_back(std::move(peer));
  return side;
}

template <typename T>
Exchange<T>::Exchange(MPI_Comm comm, MessageTag tag, const std::vector<Transfer> &sends,
                      const std::vector<Transfer> &receives) :
    comm_(comm),
    tag_(tag)
{
  int me, ranks;
  MPI_Comm_rank(comm, &me);
  MPI_Comm_size(comm, &ranks);
  sends_ = sorted(me, ranks, sends);
  receives_ = sorted(me, ranks, receives);
  const std::size_t capacity = max_components * std::max(sends_.size, receives_.size);
  outgoing_ = Buffer<T>(capacity);
  incoming_ = Buffer<T>(capacity);
  requests_.resize(sends_.peers.size() + receives_.peers.size());
}

template <typename T>
void Exchange<T>::run(const View<T> *from, const View<T> *to, int components, const Side &out,
                      const Side &in, bool add)
{
  MPI_Request *request = requests_.data();
  T *arriving = incoming_.data();
  for (const Peer &peer : in.peers) {
    const int count = static_cast<int>(components * peer.size);
    MPI_Irecv(arriving, count, mpi_type(T{}), peer.rank, tag_, comm_, request++);
    arriving += components * peer.size;
  }

  T *leaving = outgoing_.data();
  for (const Peer &peer : out.peers) {
    T *begin = leaving;
    for (int c = 0; c < components; ++c)
      for (const Box &box : peer.boxes) leaving = pack(from[c], box, leaving);
    const std::ptrdiff_t count = leaving - begin;
    MPI_Isend(begin, static_cast<int>(count), mpi_type(T{}), peer.rank, tag_, comm_, request++);
    ++traffic_.messages;
    traffic_.bytes += static_cast<long>(count * sizeof(T));
  }

  for (std::size_t n = 0; n < out.self.size(); ++n)
    for (int c = 0; c < components; ++c) transfer(from[c], out.self[n], to[c], in.self[n], add);

  MPI_Waitall(static_cast<int>(request - requests_.data()), requests_.data(), MPI_STATUSES_IGNORE);
  const T *arrived = incoming_.data();
  for (const Peer &peer : in.peers)
    for (int c = 0; c < components; ++c)
      for (const Box &box : peer.boxes) arrived = unpack(to[c], box, arrived, add);
}

template class Exchange<double>;
template class Exchange<std::complex<double>>;

}    // namespace fluid
