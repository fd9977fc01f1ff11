#pragma once

#include <cmath>
#include <cstddef>

namespace rbc {

/// Three numbers and no more. Compilers take loops over them apart and vectorise these, which they
/// do not with Eigen's vectors.
struct PlainVector {
  double x, y, z;
};

inline PlainVector operator+(PlainVector a, PlainVector b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline PlainVector operator-(PlainVector a, PlainVector b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline PlainVector operator*(double s, PlainVector a)
{
  return {s * a.x, s * a.y, s * a.z};
}

/// Of point n in an array of three numbers for each point.
inline PlainVector at(const double *x, int n)
{
  const double *const point = x + 3 * std::ptrdiff_t(n);
  return {point[0], point[1], point[2]};
}

inline double dot(PlainVector a, PlainVector b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline PlainVector cross(PlainVector a, PlainVector b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double norm(PlainVector a)
{
  return std::sqrt(dot(a, a));
}

}    // namespace rbc
