#pragma once

#include "contact/disjoint_sets.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace rbc {

/// Part of a cell's surface, as a share of all of it, that lies near another cell.
struct TouchedShare {
  int cell, other;
  double share;
};

/// Makes one share of those of the same cell and other cell.
inline void add_up(std::vector<TouchedShare> &shares)
{
  const auto key = [](const TouchedShare &s) { return std::tie(s.cell, s.other, s.share); };
  std::sort(shares.begin(), shares.end(),
            [&](const TouchedShare &a, const TouchedShare &b) { return key(a) < key(b); });
  auto sum = shares.begin();
  for (auto part = shares.begin(); part != shares.end(); ++part) {
    if (part == sum) continue;
    if (part->cell == sum->cell && part->other == sum->other)
      sum->share += part->share;
    else
      *++sum = *part;
  }
  if (!shares.empty()) shares.erase(sum + 1, shares.end());
}

/// Merges cells a and b if the fraction of the surface of either that is near the other is at least
/// `least`. Any fraction merges them if `least` is 0. The fraction of a pair may come in parts.
inline void unite_touching(DisjointSets &cells, std::vector<TouchedShare> shares, double least)
{
  add_up(shares);
  for (const TouchedShare &pair : shares)
    if (pair.share >= least) cells.unite(pair.cell, pair.other);
}

}    // namespace rbc
