#include "fluid/torsion.h"

#include <algorithm>
#include <numeric>

namespace fluid {

namespace {

constexpr double tolerance = 1e-10;    // of the residual, relative to the right-hand side
constexpr int none = -1;
using Vector = std::vector<double>;

double dot(const Vector &a, const Vector &b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// The 7-point operator -lap on these cells, zero beyond them.
class Laplacian {
 public:
  Laplacian(const Grid &grid, const std::vector<std::int64_t> &cells) : next_(cells.size())
  {
    for (int d = 0; d < 3; ++d) strength_[d] = 1 / (grid.spacing[d] * grid.spacing[d]);
    const auto &n = grid.cells;
    for (std::size_t m = 0; m < cells.size(); ++m) {
      const Index3 here{int(cells[m] % n[0]), int(cells[m] / n[0] % n[1]),
                        int(cells[m] / n[0] / n[1])};
      for (int d = 0; d < 3; ++d) {
        Index3 next = here;
        next[d] = (here[d] + 1) % n[d];
        const bool apart = n[d] == 1 || (d == 2 && grid.plates && next[d] == 0);
        next_[m][d] = apart ? none : find(cells, grid.domain().offset(next[0], next[1], next[2]));
      }
    }
  }

  void apply(const Vector &x, Vector &result) const
  {
    const double diagonal = 2 * (strength_[0] + strength_[1] + strength_[2]);
    for (std::size_t m = 0; m < x.size(); ++m) result[m] = diagonal * x[m];
    for (std::size_t m = 0; m < next_.size(); ++m)
      for (int d = 0; d < 3; ++d) {
        const int other = next_[m][d];
        if (other == none) continue;
        result[m] -= strength_[d] * x[other];
        result[other] -= strength_[d] * x[m];
      }
  }

 private:
  std::vector<Index3> next_;    ///< rows of the cells that follow in each direction
  Real3 strength_;

  static int find(const std::vector<std::int64_t> &cells, std::int64_t cell)
  {
    const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
    return found != cells.end() && *found == cell ? int(found - cells.begin()) : none;
  }
};

}    // namespace

/// By conjugate gradients.
std::vector<double> torsion_function(const Grid &grid, const std::vector<std::int64_t> &cells)
{
  const Laplacian laplacian(grid, cells);
  const std::size_t n = cells.size();
  Vector solution(n, 0.0), residual(n, 1.0), direction = residual, response(n);
  double square = dot(residual, residual);
  const double enough = tolerance * tolerance * square;
  for (std::size_t iteration = 0; square > enough && iteration < 10 * n; ++iteration) {
    laplacian.apply(direction, response);
    const double step = square / dot(direction, response);
    for (std::size_t m = 0; m < n; ++m) solution[m] += step * direction[m];
    for (std::size_t m = 0; m < n; ++m) residual[m] -= step * response[m];
    const double before = square;
    square = dot(residual, residual);
    for (std::size_t m = 0; m < n; ++m) direction[m] = residual[m] + square / before * direction[m];
  }
  return solution;
}

}    // namespace fluid
