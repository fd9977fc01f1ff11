#include "contact/aggregate_sizes.h"
#include "contact/touching_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

using rbc::AggregateSizes;
using rbc::DisjointSets;
using rbc::TouchedShare;

namespace {

using Pairs = std::vector<std::pair<int, int>>;

DisjointSets united(int size, const Pairs &pairs)
{
  DisjointSets sets(size);
  for (const auto &[a, b] : pairs) sets.unite(a, b);
  return sets;
}

/// The smallest number that can be reached from each, by passing it on until nothing changes.
std::vector<int> smallest_reached(int size, const Pairs &pairs)
{
  std::vector<int> least(size);
  std::iota(least.begin(), least.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto &[a, b] : pairs) {
      const int smaller = std::min(least[a], least[b]);
      changed = changed || least[a] != least[b];
      least[a] = least[b] = smaller;
    }
  }
  return least;
}

Pairs random_pairs(int size, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> any(0, size - 1);
  Pairs pairs(count);
  for (auto &[a, b] : pairs) {
    a = any(random);
    b = any(random);
  }
  return pairs;
}

TEST(DisjointSets, AreTheConnectedPartsNamedAfterTheirSmallestMember)
{
  for (int size : {1, 2, 7, 60})
    for (int count : {0, size / 4, size / 2, size, 3 * size})
      for (unsigned seed = 1; seed <= 5; ++seed) {
        const Pairs pairs = random_pairs(size, count, seed);
        DisjointSets sets = united(size, pairs);
        const std::vector<int> expected = smallest_reached(size, pairs);
        for (int n = 0; n < size; ++n) EXPECT_EQ(sets.find(n), expected[n]);
      }
}

TEST(DisjointSets, TellWhichPairsJoinedTwoSets)
{
  const int size = 200;
  const Pairs pairs = random_pairs(size, 400, 3);
  DisjointSets sets(size);
  Pairs needed;
  for (const auto &[a, b] : pairs)
    if (sets.unite(a, b)) needed.emplace_back(a, b);
  EXPECT_EQ(static_cast<int>(needed.size()), size - AggregateSizes(sets).aggregates());
  DisjointSets again = united(size, needed);
  for (int n = 0; n < size; ++n) EXPECT_EQ(again.find(n), sets.find(n));
}

TEST(AggregateSizes, OfAChain)
{
  const int size = 1000;
  Pairs pairs;
  for (int n = size - 1; n > 0; --n) pairs.emplace_back(n, n - 1);
  DisjointSets sets = united(size, pairs);
  const AggregateSizes sizes(sets);
  EXPECT_EQ(sizes.aggregates(), 1);
  EXPECT_EQ(sizes.mean(), size);
  EXPECT_EQ(sizes.median(), size);
  EXPECT_EQ(sizes.largest(), size);
  EXPECT_EQ(sizes.single_share(), 0);
  EXPECT_EQ(sizes.size_class(9).aggregates, 1);
}

TEST(AggregateSizes, OfCellsOneByOneAndOfNone)
{
  DisjointSets sets(5), none(0);
  const AggregateSizes sizes(sets);
  EXPECT_EQ(sizes.aggregates(), 5);
  EXPECT_EQ(sizes.mean(), 1);
  EXPECT_EQ(sizes.median(), 1);
  EXPECT_EQ(sizes.single_share(), 1);
  EXPECT_EQ(sizes.size_class(0).fraction, 1);

  const AggregateSizes empty(none);
  EXPECT_EQ(empty.aggregates(), 0);
  EXPECT_EQ(empty.mean(), 0);
  EXPECT_EQ(empty.median(), 0);
  EXPECT_EQ(empty.largest(), 0);
  EXPECT_EQ(empty.single_share(), 0);
  EXPECT_EQ(empty.size_class(0).fraction, 0);
}

TEST(AggregateSizes, OfTheSizesOneToSixteen)
{
  // one aggregate of each size from 1 to 16: 2^n of them from 2^n to below 2^(n + 1)
  const int largest = 16, size = largest * (largest + 1) / 2;
  DisjointSets sets(size);
  for (int members = 1, first = 0; members <= largest; first += members++)
    for (int n = 1; n < members; ++n) sets.unite(first, first + n);
  const AggregateSizes sizes(sets);
  EXPECT_EQ(sizes.aggregates(), largest);
  EXPECT_EQ(sizes.mean(), 8.5);
  EXPECT_EQ(sizes.median(), 8.5);
  EXPECT_EQ(sizes.largest(), largest);
  EXPECT_EQ(sizes.single_share(), 1.0 / size);
  for (int n = 0; n < 4; ++n) {
    EXPECT_EQ(sizes.size_class(n).lower, 1 << n);
    EXPECT_EQ(sizes.size_class(n).aggregates, 1 << n);
    EXPECT_EQ(sizes.size_class(n).fraction, (1 << n) / 16.0);
  }
  EXPECT_EQ(sizes.size_class(4).aggregates, 1);
  EXPECT_EQ(sizes.size_class(5).aggregates, 0);
}

TEST(AggregateSizes, ClassesHoldTheLargestAggregateThereCanBe)
{
  EXPECT_EQ(AggregateSizes::class_count(0), 0);
  for (int size = 1; size < 70; ++size) {
    DisjointSets sets(size);
    for (int n = 1; n < size; ++n) sets.unite(0, n);
    const AggregateSizes sizes(sets);
    const int last = AggregateSizes::class_count(size) - 1;
    EXPECT_EQ(sizes.size_class(last).aggregates, 1) << size;
  }
}

TEST(AggregateSizes, OfPercolationOnALine)
{
  // of neighbors joined with probability p, a share (1 - p) p^(s - 1) of the aggregates has size s
  // (Stauffer and Aharony, Introduction to Percolation Theory, chapter 2): p^(2^n - 1) - p^(2^(n +
  // 1) - 1) are in class n
  const int size = 400000;
  std::mt19937 random(11);
  for (double p : {0.3, 0.8, 0.9}) {
    std::bernoulli_distribution joined(p);
    DisjointSets sets(size);
    for (int n = 1; n < size; ++n)
      if (joined(random)) sets.unite(n - 1, n);
    const AggregateSizes sizes(sets);
    const double count = sizes.aggregates();
    EXPECT_NEAR(count, size * (1 - p), 5 * std::sqrt(size * p * (1 - p)));
    for (int n = 0; n < 8; ++n) {
      const double expected = std::pow(p, (1 << n) - 1) - std::pow(p, (2 << n) - 1);
      const double deviation = std::sqrt(expected * (1 - expected) / count);
      EXPECT_NEAR(sizes.size_class(n).fraction, expected, 5 * deviation + 1 / count)
          << p << " " << n;
    }
    // half of them are at most of the size at which 1 - p^s passes 1/2
    EXPECT_EQ(sizes.median(), std::ceil(std::log(0.5) / std::log(p))) << p;
  }
}

TEST(TouchingCells, AddUpTheSharesOfEachPairAndDirection)
{
  std::vector<TouchedShare> shares{{4, 3, 0.25}, {0, 1, 0.5}, {3, 4, 0.5}, {0, 1, 0.25}, {0, 2, 1}};
  rbc::add_up(shares);
  ASSERT_EQ(shares.size(), 4u);
  const std::vector<TouchedShare> expected{{0, 1, 0.75}, {0, 2, 1}, {3, 4, 0.5}, {4, 3, 0.25}};
  for (int n = 0; n < 4; ++n) {
    EXPECT_EQ(shares[n].cell, expected[n].cell);
    EXPECT_EQ(shares[n].other, expected[n].other);
    EXPECT_EQ(shares[n].share, expected[n].share);
  }
  shares.clear();
  rbc::add_up(shares);
  EXPECT_TRUE(shares.empty());
}

TEST(TouchingCells, OneOfTheTwoMustReachTheShare)
{
  const std::vector<TouchedShare> shares{{0, 1, 0.06}, {2, 1, 0.05},
                                         {0, 1, 0.05},    // 0.11 of cell 0
                                         {1, 2, 0.06},    // 0.05 and 0.06
                                         {4, 3, 0.02}, {3, 4, 0.2}};
  DisjointSets sets(6);
  rbc::unite_touching(sets, shares, 0.1);
  EXPECT_EQ(sets.find(1), 0);
  EXPECT_EQ(sets.find(2), 2);
  EXPECT_EQ(sets.find(4), 3);
  EXPECT_EQ(sets.find(5), 5);

  DisjointSets any(6);
  rbc::unite_touching(any, shares, 0);
  EXPECT_EQ(any.find(2), 0);
  EXPECT_EQ(any.find(4), 3);
}

}    // namespace
