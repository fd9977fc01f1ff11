#include "packing/periodic_stretch.h"

#include <algorithm>

namespace rbc {

void PeriodicStretch::follow(const std::vector<Cell> &cells)
{
  std::set<std::int64_t> inside;
  std::vector<Cell> waiting;
  for (const Cell &cell : cells) {
    if (cell.beside) continue;
    if (cell.along >= 0 && cell.along < length_) inside.insert(cell.id);
    const bool waited = std::find(waiting_.begin(), waiting_.end(), cell.id) != waiting_.end();
    if (cell.along >= length_ && cell.along < length_ + patience_ &&
        (waited || inside_.count(cell.id)))
      waiting.push_back(cell);
  }
  std::sort(waiting.begin(), waiting.end(), [](const Cell &a, const Cell &b) {
    return a.along != b.along ? a.along > b.along : a.id < b.id;
  });
  inside_ = std::move(inside);
  waiting_.clear();
  for (const Cell &cell : waiting) waiting_.push_back(cell.id);
}

void PeriodicStretch::copied(std::int64_t id)
{
  waiting_.erase(std::remove(waiting_.begin(), waiting_.end(), id), waiting_.end());
}

std::vector<double> PeriodicStretch::state() const
{
  std::vector<double> state{static_cast<double>(inside_.size())};
  state.insert(state.end(), inside_.begin(), inside_.end());
  state.insert(state.end(), waiting_.begin(), waiting_.end());
  return state;
}

void PeriodicStretch::restore(const std::vector<double> &state)
{
  inside_.clear();
  waiting_.clear();
  if (state.empty()) return;
  const auto middle = state.begin() + 1 + static_cast<std::ptrdiff_t>(state[0]);
  for (auto id = state.begin() + 1; id != middle; ++id)
    inside_.insert(static_cast<std::int64_t>(*id));
  for (auto id = middle; id != state.end(); ++id)
    waiting_.push_back(static_cast<std::int64_t>(*id));
}

}    // namespace rbc
