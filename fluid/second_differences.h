#pragma once

#include "fluid/field.h"

namespace fluid {

/// The sum of the second differences over the directions at the n cells from (i, j, k) on of a
/// field whose neighbors in all directions are stored.
inline void second_differences(const View<double> &u, int i, int j, int k, int n, double *sum)
{
  const std::ptrdiff_t row = u.box.extent(0), plane = row * u.box.extent(1);
  const double *const at = &u(i, j, k);
#pragma omp simd
  for (int m = 0; m < n; ++m)
    sum[m] = at[m - 1] + at[m + 1] + at[m - row] + at[m + row] + at[m - plane] + at[m + plane] -
             6 * at[m];
}

}    // namespace fluid
