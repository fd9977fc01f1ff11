#pragma once

#include "fluid/box.h"

#include <fftw3.h>
#include <memory>
#include <new>

namespace fluid {

/// Array stored elsewhere over a box, x fastest.
template <typename T> struct View {
  T *data = nullptr;
  Box box;

  T &operator()(int i, int j, int k) const { return data[box.offset(i, j, k)]; }
};

/// SIMD-aligned memory of fixed length. Throws std::bad_alloc if there is none.
template <typename T> class Buffer {
 public:
  Buffer() = default;

  /// Memory of another owner, who keeps it as long as this is used.
  Buffer(T *lent, std::size_t length) : length_(length), data_(lent, Free{false}) {}

  explicit Buffer(std::size_t length) :
      length_(length),
      data_(static_cast<T *>(fftw_malloc(std::max<std::size_t>(length, 1) * sizeof(T))))
  {
    if (!data_) throw std::bad_alloc();
    std::fill_n(data_.get(), length, T{});
  }

  T *data() const { return data_.get(); }
  std::size_t size() const { return length_; }
  /// Of its own.
  std::size_t bytes() const { return data_.get_deleter().owned ? length_ * sizeof(T) : 0; }
  void clear() { std::fill_n(data_.get(), length_, T{}); }

 private:
  struct Free {
    bool owned = true;
    void operator()(T *p) const
    {
      if (owned) fftw_free(p);
    }
  };
  std::size_t length_ = 0;
  std::unique_ptr<T, Free> data_;
};

/// One or more scalar components over the same box, each contiguous.
template <typename T, int N> class Components {
 public:
  Components() = default;
  explicit Components(const Box &box) : box_(box), values_(N * box.size()) {}
  Components(const Box &box, T *lent) : box_(box), values_(lent, N * box.size()) {}

  const Box &box() const { return box_; }
  View<T> operator[](int c) const { return {values_.data() + c * box_.size(), box_}; }
  std::array<View<T>, N> views() const
  {
    std::array<View<T>, N> views;
    for (int c = 0; c < N; ++c) views[c] = (*this)[c];
    return views;
  }
  void clear() { values_.clear(); }
  std::size_t bytes() const { return values_.bytes(); }

 private:
  Box box_;
  Buffer<T> values_;
};

using ScalarField = Components<double, 1>;
using VectorField = Components<double, 3>;

}    // namespace fluid
