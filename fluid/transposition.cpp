#include "fluid/transposition.h"

#include "fluid/message_tags.h"

namespace fluid {

namespace {

/// Of the part `box` of an array over the box `stored`.
DataType part_type(const Box &stored, const Box &box)
{
  int sizes[3], subsizes[3], starts[3];
  for (int d = 0; d < 3; ++d) {
    sizes[d] = stored.extent(d);
    subsizes[d] = box.extent(d);
    starts[d] = box.lo[d] - stored.lo[d];
  }
  MPI_Datatype type;
  MPI_Type_create_subarray(3, sizes, subsizes, starts, MPI_ORDER_FORTRAN, MPI_C_DOUBLE_COMPLEX,
                           &type);
  return DataType(type);
}

DataType repeated(const DataType &one, int count, std::ptrdiff_t stride)
{
  MPI_Datatype type;
  MPI_Type_create_hvector(count, 1, stride * sizeof(Complex), one.get(), &type);
  return DataType(type);
}

}    // namespace

void Transposition::Side::put(int component, const View<Complex> &plane, int k) const
{
  for (const Piece &piece : pieces_) {
    const Box &box = piece.box;
    if (k < box.lo[2] || k >= box.hi[2]) continue;
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      std::copy_n(&plane(box.lo[0], j, k), box.extent(0), piece.row(component, j, k));
  }
}

void Transposition::Side::take(int component, const View<Complex> &plane, int k) const
{
  for (const Piece &piece : pieces_) {
    const Box &box = piece.box;
    if (k < box.lo[2] || k >= box.hi[2]) continue;
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      std::copy_n(piece.row(component, j, k), box.extent(0), &plane(box.lo[0], j, k));
  }
}

void Transposition::Side::add(int rank, const Box &box, const View<Complex> &stored,
                              std::ptrdiff_t component_stride)
{
  DataType one = part_type(stored.box, box);
  DataType three = repeated(one, max_components, component_stride);
  pieces_.push_back({rank, box, stored, component_stride, std::move(one), std::move(three)});
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

  Complex *free = storage_.data();
  const auto add_alone = [&free](Side &side, int r, const Box &box) {
    side.add(r, box, {free, box}, box.size());
    free += max_components * box.size();
  };
  for (const auto &[r, box] : overlaps(to[rank_], from)) {
    if (whole)
      to_.add(r, box, (*whole)[0], whole->box().size());
    else
      add_alone(to_, r, box);
    if (r == rank_) {
      const Side::Piece &self = to_.pieces_.back();
      from_.add(r, box, self.stored, self.component_stride);
    }
  }
  for (const auto &[r, box] : overlaps(from[rank_], to))
    if (r != rank_) add_alone(from_, r, box);
  requests_.resize(from_.pieces_.size() + to_.pieces_.size());
}

void Transposition::exchange(const Side &out, const Side &in, int components)
{
  MPI_Request *request = requests_.data();
  const auto start = [&](const Side::Piece &piece, auto operation) {
    const DataType &type =
        components == max_components ? piece.three_components : piece.one_component;
    operation(piece.stored.data, 1, type.get(), piece.rank, TRANSPOSITION_TAG, comm_, request++);
  };
  for (const auto &piece : in.pieces_)
    if (piece.rank != rank_) start(piece, MPI_Irecv);
  for (const auto &piece : out.pieces_) {
    if (piece.rank == rank_) continue;
    start(piece, MPI_Isend);
    ++traffic_.messages;
    traffic_.bytes += static_cast<long>(components * piece.box.size() * sizeof(Complex));
  }
  MPI_Waitall(static_cast<int>(request - requests_.data()), requests_.data(), MPI_STATUSES_IGNORE);
}

}    // namespace fluid
