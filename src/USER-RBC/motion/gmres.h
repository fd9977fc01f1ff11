#pragma once

#include "motion/kept_directions.h"
#include "motion/motion.h"

#include <functional>

namespace rbc {

/// Generalised minimal residual method for A y = r with a linear operator known by its action only
/// (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856), without restarts: it keeps a vector
/// and a column of numbers for each iteration that was ever needed.
class Gmres {
 public:
  using Operator = std::function<void(const Numbers &, Numbers &)>;

  int max_iterations = 100;

  /// Adds to y the solution for r, until the length of the residual is not above `tolerance` or
  /// max_iterations were made. Returns that length. Directions `kept` of earlier solves are a right
  /// preconditioner of this one, and the solution found is kept with them; then r is overwritten.
  /// Two sums over ranks per iteration, three with `kept`, and up to four for the solution.
  double solve(const Operator &apply, const Motion &motion, Numbers &r, double tolerance,
               Numbers &y, KeptDirections *kept = nullptr);

  int iterations() const { return iterations_; }    ///< of the last solve
  std::size_t bytes() const;

 private:
  std::vector<Numbers> basis_;
  std::vector<Numbers> hessenberg_;    ///< column k has k + 2 entries
  Numbers rotated_, cosine_, sine_;
  Numbers direction_;    ///< where directions are kept: the one that is tried, then the solution
  int iterations_ = 0;

  void make_room(int k, std::size_t n);
  double orthogonalise(const Motion &motion, int k);
  void rotate(int k);
  void take_off_residual(int k, Numbers &r) const;
  void solve_triangle(int k);
  void add_solution(int k, Numbers &y) const;
};

}    // namespace rbc
