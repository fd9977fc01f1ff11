#pragma once

#include <limits>

namespace rbc {

/// Calls f(n) for n < count in any order, many at once where f allows it: no branches, no calls
/// that are not inlined, vectors only of numbers by name (PlainVector).
template <typename Function>
[[gnu::always_inline]] inline void for_each(int count, const Function &f)
{
#pragma omp simd
  for (int n = 0; n < count; ++n) f(n);
}

/// Sum of f(n) for n < count, likewise.
template <typename Function> [[gnu::always_inline]] inline double sum(int count, const Function &f)
{
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int n = 0; n < count; ++n) sum += f(n);
  return sum;
}

/// Bounds of several numbers; those of none are the wrong way around.
struct Bounds {
  double lowest, highest;
};

/// Bounds of f(n) for begin <= n < end, likewise, for whole groups of as many numbers as GROUP, of
/// the type Number.
constexpr int GROUP = 4;
template <typename Number = double, typename Function>
[[gnu::always_inline]] inline Bounds bounds(int begin, int end, const Function &f)
{
  constexpr Number never = std::numeric_limits<Number>::max();
  Number lowest[GROUP], highest[GROUP];
  for_each(GROUP, [&](int lane) {
    lowest[lane] = never;
    highest[lane] = -never;
  });
  for (int from = begin; from < end; from += GROUP)
    for_each(GROUP, [&](int lane) {
      const Number number = f(from + lane);
      lowest[lane] = number < lowest[lane] ? number : lowest[lane];
      highest[lane] = number > highest[lane] ? number : highest[lane];
    });
  for (int lane = 1; lane < GROUP; ++lane) {
    lowest[0] = lowest[lane] < lowest[0] ? lowest[lane] : lowest[0];
    highest[0] = highest[lane] > highest[0] ? highest[lane] : highest[0];
  }
  return {lowest[0], highest[0]};
}

}    // namespace rbc
