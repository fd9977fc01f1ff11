#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace fluid {

using Index3 = std::array<int, 3>;
using Real3 = std::array<double, 3>;

/// Half-open range of grid indices, lo <= i < hi in each direction.
struct Box {
  Index3 lo{0, 0, 0};
  Index3 hi{0, 0, 0};

  int extent(int d) const { return std::max(0, hi[d] - lo[d]); }
  std::size_t size() const { return std::size_t(extent(0)) * extent(1) * extent(2); }
  bool empty() const { return size() == 0; }
  bool contains(const Index3 &i) const
  {
    for (int d = 0; d < 3; ++d)
      if (i[d] < lo[d] || i[d] >= hi[d]) return false;
    return true;
  }

  /// Offset of index (i, j, k) in an array stored over this box, x fastest.
  std::ptrdiff_t offset(int i, int j, int k) const
  {
    return (i - lo[0]) +
           std::ptrdiff_t(extent(0)) * ((j - lo[1]) + std::ptrdiff_t(extent(1)) * (k - lo[2]));
  }

  Box shifted(const Index3 &by) const
  {
    Box box = *this;
    for (int d = 0; d < 3; ++d) {
      box.lo[d] += by[d];
      box.hi[d] += by[d];
    }
    return box;
  }

  friend bool operator==(const Box &a, const Box &b)
  {
    return (a.empty() && b.empty()) || (a.lo == b.lo && a.hi == b.hi);
  }
};

inline Box intersection(const Box &a, const Box &b)
{
  Box box;
  for (int d = 0; d < 3; ++d) {
    box.lo[d] = std::max(a.lo[d], b.lo[d]);
    box.hi[d] = std::min(a.hi[d], b.hi[d]);
  }
  return box.empty() ? Box{} : box;
}

/// Visits the rows of a box along x: visit(j, k).
template <typename Visit> void for_each_row(const Box &box, Visit visit)
{
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j) visit(j, k);
}

/// Visits the cells of a box: visit(i, j, k).
template <typename Visit> void for_each_cell(const Box &box, Visit visit)
{
  for_each_row(box, [&](int j, int k) {
    for (int i = box.lo[0]; i < box.hi[0]; ++i) visit(i, j, k);
  });
}

}    // namespace fluid
