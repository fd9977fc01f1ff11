#include "packing/periodic_stretch.h"

#include <algorithm>
#include <iterator>

namespace rbc {

namespace {

// of the stretch: the loop at first, and at the least

constexpr double first_part = 0.75, least_part = 0.5;

// Copies come nearer to their cells, in the time in which a cell goes through the loop, by a part
// of the loop: so many times the part of its cells that is owed, and the part by which their flux
// is too low. A deviation then decays within some loops and does not swing. More than `fastest`
// would press them together.

constexpr double by_owed = 0.5, by_flux = 2, fastest = 0.05;

// cells that have come too much from which on a cell gets no copy

constexpr double too_many = 2;

// leads, from the stretch on, beyond which cells do not count

constexpr double beyond = 3;

// The state begins with it. That of version 0.5, which had no loop, began with a count.

constexpr double newer = -1;

bool is_ahead(double along, std::int64_t id, double other, std::int64_t other_id)
{
  return along != other ? along > other : id < other_id;
}

}    // namespace

PeriodicStretch::PeriodicStretch(double length, double lead) :
    length_(length), lead_(lead), loop_(first_part * length)
{
}

bool PeriodicStretch::is_elsewhere(const Cell &cell) const
{
  return cell.beside || cell.along < -beyond * lead_ || cell.along >= length_ + beyond * lead_;
}

int PeriodicStretch::follow(const std::vector<Cell> &cells, double owed)
{
  Places now;
  for (const Cell &cell : cells)
    if (!is_elsewhere(cell)) now[cell.id] = cell.along;
  if (!places_.empty()) adjust(now, owed);
  due_ = 0;
  const int passed = release(now);
  find_waiting(now);
  const auto skipped = now.find(skipped_);
  if (skipped == now.end() || skipped->second >= loop_) skipped_ = 0;
  places_ = std::move(now);
  return passed;
}

/// The flux of cells, as a number that passes in the same time, is the sum of their ways in the
/// loop over its length.
void PeriodicStretch::adjust(const Places &now, double owed)
{
  double count = 0, way = 0;
  for (const auto &[id, along] : now) {
    if (along < 0 || along >= loop_) continue;
    ++count;
    const auto before = places_.find(id);
    if (before != places_.end()) way += along - before->second;
  }
  if (count == 0 || due_ <= 0) return;
  const double missing = (due_ - way / loop_) / due_;
  const double nearer = std::clamp(by_owed * owed / count + by_flux * missing, -fastest, fastest);
  loop_ = std::clamp(loop_ * (1 - nearer * due_ / count), least_part * length_, length_);
}

int PeriodicStretch::release(const Places &now)
{
  int passed = 0;
  std::map<std::int64_t, Copy> copies;
  retired_.clear();
  for (auto copy = free_.begin(); copy != free_.end();) {
    const auto place = now.find(*copy);
    const bool past = place == now.end() || place->second >= 0;
    passed += past;
    copy = past ? free_.erase(copy) : std::next(copy);
  }
  for (const auto &[id, copy] : copies_) {
    if (now.count(copy.id) == 0) continue;
    const auto cell = now.find(id);
    if (cell == now.end() || cell->second >= loop_ + copy.shift) {
      done_.insert(id);
      ++passed;
    } else if (cell->second < loop_ - 2 * lead_)
      retired_.push_back(copy.id);
    else
      copies[id] = copy;
  }
  copies_ = std::move(copies);
  return passed;
}

void PeriodicStretch::find_waiting(const Places &now)
{
  std::set<std::int64_t> led, wanted, done;
  for (const auto &[id, copy] : copies_) led.insert(copy.id);
  waiting_.clear();
  for (const auto &[id, along] : now) {
    if (along < loop_ - 2 * lead_ || copies_.count(id) || led.count(id)) continue;
    const bool waited = wanted_.count(id) != 0;
    if (done_.count(id) || (waited && along >= loop_ + lead_))
      done.insert(id);
    else if (waited || (along >= loop_ - lead_ && along < loop_)) {
      wanted.insert(id);
      waiting_.push_back({id, along, false});
    }
  }
  wanted_ = std::move(wanted);
  done_ = std::move(done);
  std::sort(waiting_.begin(), waiting_.end(),
            [](const Cell &a, const Cell &b) { return is_ahead(a.along, a.id, b.along, b.id); });
}

std::vector<double> PeriodicStretch::shifts(const Cell &cell, int most) const
{
  std::vector<double> shifts;
  const double ahead = cell.along - loop_;
  for (int n = 0; n <= most; ++n) {
    const double shift = std::max(0.0, ahead) + n * lead_ / most;
    if (shift > ahead + lead_) break;
    shifts.push_back(shift);
  }
  return shifts;
}

void PeriodicStretch::copied(const Copy &copy)
{
  copies_[copy.cell] = copy;
  places_[copy.id] = places_[copy.cell] - loop_ - copy.shift;
  wanted_.erase(copy.cell);
}

void PeriodicStretch::skip(std::int64_t cell)
{
  done_.insert(cell);
  skipped_ = cell;
  wanted_.erase(cell);
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                [cell](const Cell &other) { return other.id == cell; }),
                 waiting_.end());
}

std::vector<PeriodicStretch::Copy> PeriodicStretch::led() const
{
  std::vector<Copy> led;
  for (const auto &[id, copy] : copies_) led.push_back(copy);
  const auto along = [this](const Copy &copy) { return places_.at(copy.cell) - copy.shift; };
  std::sort(led.begin(), led.end(), [&](const Copy &a, const Copy &b) {
    return is_ahead(along(a), a.cell, along(b), b.cell);
  });
  return led;
}

void PeriodicStretch::let_go(std::int64_t cell)
{
  free_.insert(copies_.at(cell).id);
  copies_.erase(cell);
  done_.insert(cell);
}

bool PeriodicStretch::is_overfull(double owed) const
{
  return loop_ >= length_ && owed < -too_many && skipped_ == 0;
}

std::vector<double> PeriodicStretch::state() const
{
  const auto number = [](auto whole) { return static_cast<double>(whole); };
  std::vector<double> state{newer,
                            loop_,
                            due_,
                            number(skipped_),
                            number(places_.size()),
                            number(copies_.size()),
                            number(free_.size()),
                            number(wanted_.size())};
  for (const auto &[id, along] : places_) state.insert(state.end(), {number(id), along});
  for (const auto &[id, copy] : copies_)
    state.insert(state.end(), {number(id), number(copy.id), copy.shift});
  state.insert(state.end(), free_.begin(), free_.end());
  state.insert(state.end(), wanted_.begin(), wanted_.end());
  state.insert(state.end(), done_.begin(), done_.end());
  return state;
}

void PeriodicStretch::restore(const std::vector<double> &state)
{
  constexpr int head = 8;
  if (state.size() < head || state[0] != newer) return;
  const auto id = [](double number) { return static_cast<std::int64_t>(number); };
  loop_ = state[1];
  due_ = state[2];
  skipped_ = id(state[3]);
  places_.clear();
  copies_.clear();
  free_.clear();
  wanted_.clear();
  done_.clear();
  auto next = state.begin() + head;
  for (auto n = id(state[4]); n > 0; --n, next += 2) places_[id(next[0])] = next[1];
  for (auto n = id(state[5]); n > 0; --n, next += 3)
    copies_[id(next[0])] = {id(next[0]), id(next[1]), next[2]};
  for (auto n = id(state[6]); n > 0; --n) free_.insert(id(*next++));
  for (auto n = id(state[7]); n > 0; --n) wanted_.insert(id(*next++));
  for (; next != state.end(); ++next) done_.insert(id(*next));
}

}    // namespace rbc
