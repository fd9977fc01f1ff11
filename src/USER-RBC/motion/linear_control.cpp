#include "motion/linear_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rbc {

namespace {

/// Solves A x = b, by Gaussian elimination with pivots; element (i, j) of A is at i + count * j.
LinearControl::Numbers solved(LinearControl::Numbers A, LinearControl::Numbers b)
{
  const int n = static_cast<int>(b.size());
  const auto at = [&](int i, int j) -> double & { return A[i + std::size_t(n) * j]; };
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    for (int j = k; j < n; ++j) std::swap(at(k, j), at(pivot, j));
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < n; ++i) {
      const double factor = at(i, k) / at(k, k);
      for (int j = k; j < n; ++j) at(i, j) -= factor * at(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[k] -= at(k, j) * b[j];
    b[k] /= at(k, k);
  }
  return b;
}

}    // namespace

void LinearControl::probe(int count, double size)
{
  inputs_.assign(count, 0.0);
  disturbance_.assign(count, 0.0);
  response_.assign(std::size_t(count) * count, 0.0);
  stage_ = 0;
  size_ = size;
}

LinearControl::Numbers LinearControl::caused() const
{
  Numbers sum(count(), 0.0);
  for (int j = 0; j < count(); ++j)
    for (int i = 0; i < count(); ++i)
      sum[i] += response_[i + std::size_t(count()) * j] * inputs_[j];
  return sum;
}

/// As many positive pivots as rows: the symmetric part of the responses is positive definite.
bool LinearControl::takes_work() const
{
  const int n = count();
  Numbers part(response_.size());
  const auto at = [&](int i, int j) -> double & { return part[i + std::size_t(n) * j]; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      at(i, j) = response_[i + std::size_t(n) * j] + response_[j + std::size_t(n) * i];
  for (int k = 0; k < n; ++k) {
    if (!(at(k, k) > 0)) return false;
    for (int i = k + 1; i < n; ++i)
      for (int j = k + 1; j < n; ++j) at(i, j) -= at(i, k) * at(k, j) / at(k, k);
  }
  return true;
}

double LinearControl::effect() const
{
  double largest = 0;
  for (double part : caused()) largest = std::max(largest, std::abs(part));
  return largest;
}

void LinearControl::adjust(const Numbers &measured, const Numbers &wanted)
{
  const int n = count();
  Numbers left = wanted;    // for the inputs to cause
  if (stage_ <= n) {
    if (stage_ == 0)
      disturbance_ = measured;
    else
      for (int i = 0; i < n; ++i)
        response_[i + std::size_t(n) * (stage_ - 1)] = (measured[i] - disturbance_[i]) / size_;
    ++stage_;
    std::fill(inputs_.begin(), inputs_.end(), 0.0);
    if (stage_ <= n) {
      inputs_[stage_ - 1] = size_;
      return;
    }
    for (int i = 0; i < n; ++i) left[i] -= disturbance_[i];
  } else {
    const Numbers part = caused();
    for (int i = 0; i < n; ++i) {
      const double before = disturbance_[i];
      disturbance_[i] = measured[i] - part[i];
      left[i] -= 2 * disturbance_[i] - before;
    }
  }
  inputs_ = solved(response_, left);
}

void LinearControl::shift(const Numbers &change)
{
  const Numbers more = solved(response_, change);
  for (int i = 0; i < count(); ++i) inputs_[i] += more[i];
}

LinearControl::Numbers LinearControl::state() const
{
  Numbers state = inputs_;
  state.insert(state.end(), disturbance_.begin(), disturbance_.end());
  state.insert(state.end(), response_.begin(), response_.end());
  return state;
}

bool LinearControl::restore(int count, const Numbers &state)
{
  if (state.size() != std::size_t(count) * (2 + count)) return false;
  const auto next = state.begin() + count;
  inputs_.assign(state.begin(), next);
  disturbance_.assign(next, next + count);
  response_.assign(next + count, state.end());
  stage_ = count + 1;
  return true;
}

}    // namespace rbc
