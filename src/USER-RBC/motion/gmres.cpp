#include "motion/gmres.h"

#include <cmath>

namespace rbc {

double Gmres::solve(const Operator &apply, const Motion &motion, Numbers &r, double tolerance,
                    Numbers &y, KeptDirections *kept)
{
  const std::size_t n = r.size();
  iterations_ = 0;
  double residual = std::sqrt(dot(motion, r, r));
  if (!(residual > tolerance)) return residual;

  make_room(0, n);
  for (std::size_t i = 0; i < n; ++i) basis_[0][i] = r[i] / residual;
  rotated_[0] = residual;

  int k = 0;
  while (k < max_iterations && residual > tolerance) {
    make_room(k + 1, n);
    if (kept) {
      direction_ = basis_[k];
      kept->precondition(motion, direction_);
    }
    apply(kept ? direction_ : basis_[k], basis_[k + 1]);
    const double length = orthogonalise(motion, k);
    rotate(k);
    residual = std::abs(rotated_[++k]);
    if (!(length > 0)) break;
  }
  iterations_ = k;

  if (!kept) {
    solve_triangle(k);
    add_solution(k, y);
    return residual;
  }
  take_off_residual(k, r);
  solve_triangle(k);
  direction_.assign(n, 0.0);
  add_solution(k, direction_);
  kept->precondition(motion, direction_);
  for (std::size_t i = 0; i < n; ++i) y[i] += direction_[i];
  kept->keep(motion, direction_, r);
  return residual;
}

/// For the basis up to vector k. What an earlier solve has needed is kept.
void Gmres::make_room(int k, std::size_t n)
{
  const std::size_t count = static_cast<std::size_t>(k) + 1;
  if (basis_.size() < count) {
    basis_.resize(count);
    hessenberg_.emplace_back(count + 1);
    for (Numbers *entries : {&rotated_, &cosine_, &sine_}) entries->resize(count);
  }
  basis_[k].resize(n);
}

/// Classical Gram-Schmidt of vector k + 1 against those before; returns the length of what is left.
double Gmres::orthogonalise(const Motion &motion, int k)
{
  Numbers &next = basis_[k + 1];
  Numbers &column = hessenberg_[k];
  for (int j = 0; j <= k; ++j) {
    double overlap = 0;
    for (std::size_t i = 0; i < next.size(); ++i) overlap += next[i] * basis_[j][i];
    column[j] = overlap;
  }
  motion.sum(column.data(), k + 1);
  for (int j = 0; j <= k; ++j)
    for (std::size_t i = 0; i < next.size(); ++i) next[i] -= column[j] * basis_[j][i];
  const double length = std::sqrt(dot(motion, next, next));
  column[k + 1] = length;
  if (length > 0)
    for (double &value : next) value /= length;
  return length;
}

/// Givens rotations that make the Hessenberg matrix triangular.
void Gmres::rotate(int k)
{
  Numbers &column = hessenberg_[k];
  for (int j = 0; j < k; ++j) {
    const double upper = column[j], lower = column[j + 1];
    column[j] = cosine_[j] * upper + sine_[j] * lower;
    column[j + 1] = cosine_[j] * lower - sine_[j] * upper;
  }
  const double diagonal = std::hypot(column[k], column[k + 1]);
  cosine_[k] = column[k] / diagonal;
  sine_[k] = column[k + 1] / diagonal;
  column[k] = diagonal;
  rotated_[k + 1] = -sine_[k] * rotated_[k];
  rotated_[k] *= cosine_[k];
}

void Gmres::add_solution(int k, Numbers &y) const
{
  for (int j = 0; j < k; ++j)
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += rotated_[j] * basis_[j][i];
}

/// Of the right-hand side r this leaves the image of the solution. To be called before
/// solve_triangle().
void Gmres::take_off_residual(int k, Numbers &r) const
{
  double last = rotated_[k];
  for (int j = k; j >= 0; --j) {
    const double entry = j > 0 ? cosine_[j - 1] * last : last;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= entry * basis_[j][i];
    if (j > 0) last *= -sine_[j - 1];
  }
}

/// Makes the first k entries of the rotated residual the weights of the basis.
void Gmres::solve_triangle(int k)
{
  for (int j = k - 1; j >= 0; --j) {
    const Numbers &column = hessenberg_[j];
    rotated_[j] /= column[j];
    for (int i = 0; i < j; ++i) rotated_[i] -= column[i] * rotated_[j];
  }
}

std::size_t Gmres::bytes() const
{
  std::size_t sum = 0;
  for (const auto *vectors : {&basis_, &hessenberg_})
    for (const Numbers &vector : *vectors) sum += vector.capacity();
  return (sum + direction_.capacity()) * sizeof(double);
}

}    // namespace rbc
