#pragma once

#include "fluid/exchange.h"

#include <complex>
#include <utility>

namespace fluid {

using Complex = std::complex<double>;

/// Owns a derived MPI type.
class DataType {
 public:
  explicit DataType(MPI_Datatype type) : type_(type) { MPI_Type_commit(&type_); }
  DataType(DataType &&other) noexcept : type_(std::exchange(other.type_, MPI_DATATYPE_NULL)) {}
  DataType &operator=(DataType &&other) noexcept
  {
    std::swap(type_, other.type_);
    return *this;
  }
  ~DataType()
  {
    if (type_ != MPI_DATATYPE_NULL) MPI_Type_free(&type_);
  }
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_;
};

/// Moves one or three components of a distributed complex array from one set of boxes (rank r owns
/// from[r]) to another, to[r]. A rank holds either of its boxes cut into pieces, one for each rank
/// it shares cells with, stored by themselves or as parts of a whole. Pieces are sent as they
/// stand, and the piece a rank shares with itself is the same memory on both sides.
class Transposition {
 public:
  /// A rank's box on one side, filled and read plane by plane (z fixed).
  class Side {
   public:
    void put(int component, const View<Complex> &plane, int k) const;
    void take(int component, const View<Complex> &plane, int k) const;

   private:
    friend class Transposition;
    struct Piece {
      int rank;
      Box box;
      View<Complex> stored;    ///< of the first component: the piece, or a whole that it is part of
      std::ptrdiff_t component_stride;
      DataType one_component, three_components;

      Complex *row(int component, int j, int k) const
      {
        return &stored(box.lo[0], j, k) + component * component_stride;
      }
    };

    void add(int rank, const Box &box, const View<Complex> &stored,
             std::ptrdiff_t component_stride);

    std::vector<Piece> pieces_;
  };

  static constexpr int max_components = 3;

  Transposition() = default;

  /// Where `whole` is given, it stores the box to[rank], and the pieces on that side are its parts.
  Transposition(MPI_Comm comm, const std::vector<Box> &from, const std::vector<Box> &to,
                const Components<Complex, max_components> *whole);

  /// Every rank's box is the same on both sides; without `whole` there are no pieces then.
  bool identity() const { return identity_; }

  const Side &from() const { return from_; }
  const Side &to() const { return to_; }
  void forward(int components) { exchange(from_, to_, components); }
  void backward(int components) { exchange(to_, from_, components); }

  const Traffic &traffic() const { return traffic_; }
  std::size_t bytes() const { return storage_.bytes(); }

 private:
  void exchange(const Side &out, const Side &in, int components);

  bool identity_ = true;
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  Buffer<Complex> storage_;
  Side from_, to_;
  std::vector<MPI_Request> requests_;
  Traffic traffic_;
};

}    // namespace fluid
