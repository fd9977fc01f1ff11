// A periodic stretch: which cells get copies, how these are led, and the loop against the length at
// which as many cells pass as are due.

#include "packing/periodic_stretch.h"

#include "../geometry/test_support.h"

#include <algorithm>
#include <cmath>
#include <iterator>

using namespace test;

namespace {

using Cells = std::vector<rbc::PeriodicStretch::Cell>;
using IDs = std::vector<std::int64_t>;

IDs waiting(const rbc::PeriodicStretch &stretch)
{
  IDs ids;
  for (const auto &cell : stretch.waiting()) ids.push_back(cell.id);
  return ids;
}

IDs led(const rbc::PeriodicStretch &stretch)
{
  IDs ids;
  for (const auto &copy : stretch.led()) ids.push_back(copy.id);
  return ids;
}

// the loop of a stretch of 20 is 15 long at first
TEST(PeriodicStretch, CellsNearTheEndOfTheLoopWaitForACopy)
{
  rbc::PeriodicStretch stretch(20, 4);
  stretch.follow(Cells{{1, 10.9, false},
                       {2, 11.5, false},
                       {3, 14.9, false},
                       {4, 15.1, false},
                       {5, 13, true},
                       {6, -1, false}},
                 0);
  EXPECT_EQ(waiting(stretch), (IDs{3, 2}));
  stretch.copied({3, 13, 0});
  // 4 was behind the end at first, 1 has come near, 2 is late
  stretch.follow(
      Cells{{1, 11.1, false}, {2, 18.9, false}, {3, 14.95, false}, {4, 16, false}, {13, 0, false}},
      0);
  EXPECT_EQ(waiting(stretch), (IDs{2, 1}));
  stretch.follow(Cells{{1, 11.2, false}, {2, 19.1, false}}, 0);
  EXPECT_EQ(waiting(stretch), IDs{1});    // 2 is given up
  stretch.skip(1);
  EXPECT_EQ(waiting(stretch), IDs{});
  stretch.follow(Cells{{1, 12, false}, {2, 14, false}}, 0);
  EXPECT_EQ(waiting(stretch), IDs{});
  // gone back and come again
  stretch.follow(Cells{{1, 6, false}, {2, 14, false}}, 0);
  stretch.follow(Cells{{1, 12, false}, {2, 14, false}}, 0);
  EXPECT_EQ(waiting(stretch), IDs{1});
}

TEST(PeriodicStretch, CopiesAppearWithinTheLeadBeforeIt)
{
  const double lead = 4;
  const rbc::PeriodicStretch stretch(20, lead);
  const int most = 8;
  for (double along : {11.0, 12.3, 15.0, 16.2, 18.9}) {
    const std::vector<double> shifts = stretch.shifts({1, along, false}, most);
    ASSERT_FALSE(shifts.empty());
    EXPECT_EQ(shifts.front(), std::max(0.0, along - 15));
    EXPECT_TRUE(std::is_sorted(shifts.begin(), shifts.end()));
    const double last = along - 15 - shifts.back();
    EXPECT_GE(last, -lead - 1e-12);
    EXPECT_LT(last, -lead + lead / most + 1e-12) << "all of the lead is tried";
  }
}

TEST(PeriodicStretch, LeadsCopiesToItsBeginning)
{
  rbc::PeriodicStretch stretch(20, 4);
  stretch.follow(Cells{{1, 12, false}, {2, 13, false}, {3, 14, false}}, 0);
  stretch.copied({1, 11, 0});
  stretch.copied({2, 12, 0});
  stretch.copied({3, 13, 2.5});
  EXPECT_EQ(led(stretch), (IDs{12, 11, 13}));
  const auto at = [&](double moved) {
    return Cells{{1, 12 + moved, false},  {2, 13 + moved, false},  {3, 14 + moved, false},
                 {11, -3 + moved, false}, {12, -2 + moved, false}, {13, -3.5 + moved, false}};
  };
  EXPECT_EQ(stretch.follow(at(1.9), 0), 0);
  EXPECT_EQ(stretch.follow(at(2.1), 0), 1);
  EXPECT_EQ(led(stretch), (IDs{11, 13}));
  stretch.let_go(1);
  EXPECT_EQ(stretch.before(), 2);
  EXPECT_EQ(stretch.follow(at(2.9), 0), 0) << "3 is beyond the end, its copy before the beginning";
  EXPECT_EQ(stretch.follow(at(3.4), 0), 1) << "the one that was let go";
  EXPECT_EQ(led(stretch), IDs{13});
  EXPECT_EQ(stretch.follow(at(3.6), 0), 1);
  EXPECT_EQ(led(stretch), IDs{});
  EXPECT_EQ(stretch.before(), 0);
  EXPECT_EQ(waiting(stretch), IDs{});
}

TEST(PeriodicStretch, TakesCopiesBackWithTheirCells)
{
  rbc::PeriodicStretch stretch(20, 4);
  stretch.follow(Cells{{1, 12, false}, {2, 13, false}, {3, 14, false}}, 0);
  for (int id : {1, 2, 3}) stretch.copied({id, 10 + id, 0});
  // 1 goes back, 2 is gone, the copy of 3 is
  EXPECT_EQ(
      stretch.follow(Cells{{1, 6.9, false}, {3, 14, false}, {11, -8, false}, {12, -2, false}}, 0),
      1);
  EXPECT_EQ(stretch.retired(), IDs{11});
  EXPECT_EQ(led(stretch), IDs{});
}

TEST(PeriodicStretch, CellsElsewhereMayBeLeftOut)
{
  rbc::PeriodicStretch all(10, 2), some(10, 2);
  int left_out = 0, waited = 0;
  for (int time = 0; time < 60; ++time) {
    Cells cells, near;
    for (int id = 1; id <= 20; ++id) {
      const double along = 7 + 12 * std::sin(0.13 * id * time + id);
      cells.push_back({id, along, id % 7 == time % 7});
      if (!all.is_elsewhere(cells.back())) near.push_back(cells.back());
    }
    for (rbc::PeriodicStretch *stretch : {&all, &some}) stretch->pass(0.1);
    all.follow(cells, 0.1 * time);
    some.follow(near, 0.1 * time);
    EXPECT_EQ(some.state(), all.state());
    left_out += static_cast<int>(cells.size() - near.size());
    waited += static_cast<int>(all.waiting().size());
  }
  EXPECT_GT(left_out, 60);
  EXPECT_GT(waited, 30);
}

/// Cells of a stretch, each at a speed of its own, whose copies all find room.
class Train {
 public:
  static constexpr double length = 80, speed = 0.25, due = 0.1;    // ways and cells in a step

  Train(int number, double spread)
  {
    Random random(2);
    for (int n = 0; n < number; ++n) {
      along_[n + 1] = (n + random.between(0, 1)) * stretch_.loop() / number;
      speed_[n + 1] = speed * (1 + spread * random.between(-1, 1));
    }
    last_ = number;
  }

  void step()
  {
    Cells cells;
    for (auto &[id, place] : along_) cells.push_back({id, place += speed_[id], false});
    owed_ += due;
    stretch_.pass(due);
    owed_ -= stretch_.follow(cells, owed_);
    for (const auto &cell : Cells(stretch_.waiting())) {
      stretch_.copied({cell.id, ++last_, 0});
      speed_[last_] = speed_[cell.id];
    }
    for (const auto &copy : stretch_.led())
      along_[copy.id] = along_[copy.cell] - stretch_.loop() - copy.shift;
    for (auto cell = along_.begin(); cell != along_.end();)
      cell = cell->second > 2 * length ? along_.erase(cell) : std::next(cell);
  }

  double owed() const { return owed_; }
  double loop() const { return stretch_.loop(); }

 private:
  rbc::PeriodicStretch stretch_{length, 8};
  std::map<std::int64_t, double> along_, speed_;
  std::int64_t last_;
  double owed_ = 0;
};

/// By counting, the number that came past the beginning is right in the end. It differs by the cell
/// that is about to come, and by as much as cells at random places do where each has another speed.
/// The loop of cells of one speed is number times speed / due long then.
TEST(PeriodicStretch, TheLoopGetsAsLongAsTheHematocritWants)
{
  for (const double spread : {0.0, 0.2})
    for (const int number : {20, 24, 28}) {
      Train train(number, spread);
      const int steps = 12000, late = steps / 2;
      double mean = 0, early = 0, furthest = 0;
      for (int step = 0; step < steps; ++step) {
        train.step();
        double &most = step < late ? early : furthest;
        most = std::max(most, std::abs(train.owed()));
        if (step >= late) mean += train.loop() / (steps - late);
      }
      if (spread == 0) {
        EXPECT_NEAR(mean, number * Train::speed / Train::due, 0.02 * mean);
      }
      EXPECT_LT(early, 0.4 * number);
      EXPECT_LT(furthest, spread == 0 ? 1.5 : std::sqrt(number));
    }
}

TEST(PeriodicStretch, TheLoopStaysWithinTheStretch)
{
  for (const bool few : {true, false}) {
    const double way = few ? 1e-3 : 1;
    rbc::PeriodicStretch stretch(20, 4);
    for (int n = 1; n < 10000; ++n) {
      stretch.pass(0.02);
      stretch.follow(Cells{{n, 3 + way, false}, {n + 1, 3, false}}, few ? 3 : -3);
    }
    EXPECT_EQ(stretch.loop(), few ? 10 : 20);
    EXPECT_EQ(stretch.is_overfull(-3), !few);
    EXPECT_FALSE(stretch.is_overfull(-1));
  }
}

TEST(PeriodicStretch, GoesOnFromItsState)
{
  rbc::PeriodicStretch one(20, 4), other(20, 4);
  one.follow(
      Cells{{6, 11.5, false}, {7, 12, false}, {8, 13, false}, {9, 14, false}, {10, 14.5, false}},
      0);
  one.copied({9, 19, 0.5});
  one.copied({6, 16, 0.5});
  one.let_go(6);
  one.skip(10);
  one.pass(0.3);
  other.restore(one.state());
  for (rbc::PeriodicStretch *stretch : {&one, &other}) {
    const double loop = stretch->loop();
    stretch->pass(0.1);
    stretch->follow(Cells{{7, 14.8, false},
                          {8, 14, false},
                          {9, 14.5, false},
                          {10, 14.9, false},
                          {12, 15.5, false},
                          {16, -2, false},
                          {19, -1, false}},
                    2);
    EXPECT_NE(stretch->loop(), loop);
    EXPECT_EQ(waiting(*stretch), (IDs{7, 8}));
    EXPECT_EQ(led(*stretch), IDs{19});
    EXPECT_EQ(stretch->before(), 2);
  }
  EXPECT_EQ(one.state(), other.state());
  other.restore({3, 1, 2, 3, 4, 5, 6});    // of version 0.5
  EXPECT_EQ(one.state(), other.state());
}

}    // namespace
