#pragma once

#include "contact/disjoint_sets.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rbc {

/// Cells in each aggregate and the statistics of these sizes. A cell that touches no other is an
/// aggregate of one.
class AggregateSizes {
 public:
  /// Aggregates of at least `lower` and fewer than twice as many cells.
  struct Class {
    std::int64_t lower;
    int aggregates;
    double fraction;    ///< of all aggregates
  };

  AggregateSizes() = default;

  explicit AggregateSizes(DisjointSets &cells) : cells_(cells.size())
  {
    std::vector<int> members(cells.size());
    for (int n = 0; n < cells.size(); ++n) ++members[cells.find(n)];
    for (int count : members)
      if (count > 0) sizes_.push_back(count);
    std::sort(sizes_.begin(), sizes_.end());
  }

  int aggregates() const { return static_cast<int>(sizes_.size()); }
  double mean() const { return sizes_.empty() ? 0 : static_cast<double>(cells_) / aggregates(); }
  int largest() const { return sizes_.empty() ? 0 : sizes_.back(); }

  /// The mean of the middle two if their number is even.
  double median() const
  {
    if (sizes_.empty()) return 0;
    const std::size_t n = sizes_.size();
    return 0.5 * (sizes_[(n - 1) / 2] + sizes_[n / 2]);
  }

  /// Share of the cells that touch no other.
  double single_share() const
  {
    return cells_ == 0 ? 0 : static_cast<double>(count_below(2)) / cells_;
  }

  /// How many classes hold every size that so many cells can have.
  static int class_count(int cells)
  {
    int count = 0;
    for (; cells > 0; cells /= 2) ++count;
    return count;
  }

  /// Of sizes from 2^n to below 2^(n + 1).
  Class size_class(int n) const
  {
    const std::int64_t lower = std::int64_t(1) << n;
    const int count = count_below(2 * lower) - count_below(lower);
    return {lower, count, sizes_.empty() ? 0 : static_cast<double>(count) / aggregates()};
  }

 private:
  int cells_ = 0;
  std::vector<int> sizes_;    ///< ascending

  int count_below(std::int64_t size) const
  {
    return static_cast<int>(std::lower_bound(sizes_.begin(), sizes_.end(), size) - sizes_.begin());
  }
};

}    // namespace rbc
