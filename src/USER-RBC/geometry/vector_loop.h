#pragma once

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

}    // namespace rbc
