#include "fluid/transposition.h"

#include "fluid/message_tags.h"

namespace fluid {

namespace {

template <typename Copy> void for_each_row(const Box &box, int k, Copy copy)
{
  if (k < box.lo[2] || k >= box.hi[2]) return;
  for (int j = box.lo[1]; j < box.hi[1]; ++j) copy(box.lo[0], j);
}

}    // namespace

void Transposition::Side::put(int component, const View<Complex> &plane, int k) const
{
  for (const Piece &piece : pieces_) {
    const Box &box = piece.values.box;
    Complex *to = piece.values.data + component * piece.component_stride;
    for_each_row(box, k, [&](int i, int j) {
      std::copy_n(&plane(i, j, k), box.extent(0), to + box.offset(i, j, k));
    });
  }
}

void Transposition::Side::take(int component, const View<Complex> &plane, int k) const
{
  for (const Piece &piece : pieces_) {
    const Box &box = piece.values.box;
    const Complex *from = piece.values.data + component * piece.component_stride;
    for_each_row(box, k, [&](int i, int j) {
      std::copy_n(from + box.offset(i, j, k), box.extent(0), &plane(i, j, k));
    });
  }
}

void Transposition::Side::add(int rank, const Box &box, Complex *data,
                              std::ptrdiff_t component_stride)
{
  MPI_Datatype type;
  MPI_Type_create_hvector(max_components, static_cast<int>(box.size()),
                          component_stride * sizeof(Complex), MPI_C_DOUBLE_COMPLEX, &type);
  pieces_.push_back({rank, {data, box}, component_stride, DataType(type)});
}

Transposition::Transposition(MPI_Comm comm, const std::vector<Box> &from,
                             const std::vector<Box> &to,
                             const Components<Complex, max_components> *whole) :
    identity_(from == to),
    comm_(comm)
{
  if (identity_ && !whole) return;
  MPI_Comm_rank(comm, &rank_);
  const std::size_t shared = intersection(from[rank_], to[rank_]).size();
  storage_ = Buffer<Complex>(max_components *
                             (from[rank_].size() - shared + (whole ? 0 : to[rank_].size())));

  Complex *free = storage_.data(), *self = nullptr;
  std::ptrdiff_t self_stride = 0;
  for (const auto &[r, box] : overlaps(to[rank_], from)) {
    Complex *data = whole ? &(*whole)[0](box.lo[0], box.lo[1], box.lo[2]) : free;
    const std::ptrdiff_t stride = whole ? whole->box().size() : box.size();
    if (!whole) free += max_components * box.size();
    to_.add(r, box, data, stride);
    if (r == rank_) {
      self = data;
      self_stride = stride;
    }
  }
  for (const auto &[r, box] : overlaps(from[rank_], to)) {
    if (r == rank_) {
      from_.add(r, box, self, self_stride);
    } else {
      from_.add(r, box, free, box.size());
      free += max_components * box.size();
    }
  }
  requests_.resize(from_.pieces_.size() + to_.pieces_.size());
}

void Transposition::exchange(const Side &out, const Side &in, int components)
{
  MPI_Request *request = requests_.data();
  const auto start = [&](const Side::Piece &piece, auto operation) {
    const bool all = components == max_components;
    const int count = all ? 1 : static_cast<int>(piece.values.box.size());
    operation(piece.values.data, count, all ? piece.three_components.get() : MPI_C_DOUBLE_COMPLEX,
              piece.rank, TRANSPOSITION_TAG, comm_, request++);
  };
  for (const auto &piece : in.pieces_)
    if (piece.rank != rank_) start(piece, MPI_Irecv);
  for (const auto &piece : out.pieces_) {
    if (piece.rank == rank_) continue;
    start(piece, MPI_Isend);
    ++traffic_.messages;
    traffic_.bytes += static_cast<long>(components * piece.values.box.size() * sizeof(Complex));
  }
  MPI_Waitall(static_cast<int>(request - requests_.data()), requests_.data(), MPI_STATUSES_IGNORE);
}

}    // namespace fluid
