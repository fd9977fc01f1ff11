#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace rbc {

/// The numbers below `size` in sets that can be united; each set is named after its smallest
/// number.
class DisjointSets {
 public:
  explicit DisjointSets(int size) : parents_(size)
  {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  int size() const { return static_cast<int>(parents_.size()); }

  int find(int n)
  {
    while (parents_[n] != n) n = parents_[n] = parents_[parents_[n]];
    return n;
  }

  /// False if a and b are in one set already.
  bool unite(int a, int b)
  {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    if (a > b) std::swap(a, b);
    parents_[b] = a;
    return true;
  }

 private:
  std::vector<int> parents_;
};

}    // namespace rbc
