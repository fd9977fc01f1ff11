#include "packing/stream_ledger.h"

#include <algorithm>
#include <cmath>

namespace rbc {

namespace {

std::vector<double> together(double inlet, const std::vector<double> &outlets)
{
  std::vector<double> rates{inlet};
  rates.insert(rates.end(), outlets.begin(), outlets.end());
  return rates;
}

/// Volume that passes forwards while the rate goes from one value to another.
double forward_volume(double dt, double before, double now)
{
  if (before >= 0 && now >= 0) return dt * (before + now) / 2;
  const double most = std::max(before, now);
  return most > 0 ? dt * most * most / (2 * std::abs(now - before)) : 0;
}

/// Within round-off.
bool are_same(const std::vector<double> &rates, const std::vector<double> &others)
{
  constexpr double same = 1e-9;    // of the largest
  if (rates.size() != others.size()) return false;
  double largest = 0, apart = 0;
  for (std::size_t n = 0; n < rates.size(); ++n) {
    largest = std::max(largest, std::abs(rates[n]));
    apart = std::max(apart, std::abs(rates[n] - others[n]));
  }
  return apart <= same * largest;
}

}    // namespace

void StreamLedger::start(double inlet, const std::vector<double> &outlets)
{
  const std::vector<double> now = together(inlet, outlets);
  if (!are_same(now, rates_)) rates_ = now;
}

double StreamLedger::pass(double dt, double inlet, const std::vector<double> &outlets)
{
  const std::vector<double> now = together(inlet, outlets);
  if (rates_.empty()) rates_ = now;
  const double entered = forward_volume(dt, rates_[0], now[0]);
  inlet_.volume += entered;
  const double due = hematocrit_ * entered / cell_volume_;
  owed_ += due;
  for (std::size_t n = 0; n < outlets_.size(); ++n)
    outlets_[n].volume += forward_volume(dt, rates_[n + 1], now[n + 1]);
  rates_ = now;
  return due;
}

void StreamLedger::let_in(int cells)
{
  owed_ -= cells;
  inlet_.cells += cells;
  inlet_.cell_volume += cells * cell_volume_;
}

void StreamLedger::let_out(int outlet)
{
  outlets_[outlet].cells += 1;
  outlets_[outlet].cell_volume += cell_volume_;
}

StreamLedger::Passage StreamLedger::left() const
{
  Passage sum;
  for (const Passage &outlet : outlets_) {
    sum.volume += outlet.volume;
    sum.cells += outlet.cells;
    sum.cell_volume += outlet.cell_volume;
  }
  return sum;
}

std::vector<double> StreamLedger::state() const
{
  std::vector<double> state{owed_};
  const auto add = [&state](const Passage &passage) {
    state.insert(state.end(), {passage.volume, passage.cells, passage.cell_volume});
  };
  add(inlet_);
  for (const Passage &outlet : outlets_) add(outlet);
  state.insert(state.end(), rates_.begin(), rates_.end());
  return state;
}

bool StreamLedger::restore(const std::vector<double> &state)
{
  const std::size_t openings = 1 + outlets_.size(), counts = 1 + 3 * openings;
  if (state.size() != counts && state.size() != counts + openings) return false;
  auto next = state.begin();
  owed_ = *next++;
  const auto take = [&next](Passage &passage) {
    passage = {next[0], next[1], next[2]};
    next += 3;
  };
  take(inlet_);
  for (Passage &outlet : outlets_) take(outlet);
  rates_.assign(next, state.end());
  return true;
}

}    // namespace rbc
