#pragma once

#include "geometry/tight_vector.h"

#include <cstddef>
#include <vector>

namespace rbc {

/// Lists of numbers, one after the other.
struct NumberLists {
  std::vector<int> number, begin{0};    ///< begin: of each list, and the end of the last

  int count() const { return static_cast<int>(begin.size()) - 1; }
  std::size_t bytes() const { return (number.capacity() + begin.capacity()) * sizeof(int); }

  /// Makes `lists` lists. `visit(put)` calls put(list, number) for all of them, the same each time.
  template <typename Visit> void fill(int lists, std::vector<int> &scratch, const Visit &visit)
  {
    begin.assign(lists + 1, 0);
    visit([this](int list, int) { ++begin[list + 1]; });
    for (int list = 0; list < lists; ++list) begin[list + 1] += begin[list];
    resize_tightly(number, begin[lists]);
    scratch.assign(begin.begin(), begin.end() - 1);
    visit([&](int list, int value) { number[scratch[list]++] = value; });
  }
};

}    // namespace rbc
