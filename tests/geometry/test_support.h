#pragma once

#include "geometry/plain_vector.h"
#include "geometry/surface_template.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test {

using rbc::Vec3;
using Matrix3 = Eigen::Matrix3d;
using Vertices = std::vector<Vec3>;
using Triangles = std::vector<rbc::SurfaceTemplate::Corners>;

constexpr double pi = 3.14159265358979323846;

// ---- meshes

struct Mesh {
  Vertices vertices;
  Triangles triangles;

  rbc::SurfaceTemplate surface() const { return {vertices, triangles}; }
};

template <typename Map> Vertices transformed(const Vertices &x, const Map &map)
{
  Vertices y;
  for (const Vec3 &vertex : x) y.push_back(map(vertex));
  return y;
}

/// Joins vertices at the same place, which may differ by round-off, into one.
class Welder {
 public:
  int index(const Vec3 &x)
  {
    const auto [at, is_new] = known_.try_emplace(
        {std::lround(x[0] * 1e8), std::lround(x[1] * 1e8), std::lround(x[2] * 1e8)},
        mesh.vertices.size());
    if (is_new) mesh.vertices.push_back(x);
    return at->second;
  }

  Mesh mesh;

 private:
  std::map<std::array<long, 3>, int> known_;
};

/// Unit sphere: each face of an icosahedron in frequency^2 triangles, 10 frequency^2 + 2 vertices.
inline Mesh icosphere(int frequency)
{
  const double golden = (1 + std::sqrt(5)) / 2;
  Vertices corner;
  for (int d = 0; d < 3; ++d)
    for (double s : {-1.0, 1.0})
      for (double t : {-golden, golden}) {
        Vec3 x = Vec3::Zero();
        x[(d + 1) % 3] = s;
        x[(d + 2) % 3] = t;
        corner.push_back(x.normalized());
      }

  const double edge_angle = std::atan(2);
  const auto weight = [&](int i) { return std::sin(edge_angle * i / frequency); };
  Welder welder;
  for (int a = 0; a < 12; ++a)
    for (int b = a + 1; b < 12; ++b)
      for (int c = b + 1; c < 12; ++c) {
        const Vec3 &p = corner[a], &q = corner[b], &r = corner[c];
        // The cosine of neighbors is 0.447, of others negative.
        if (std::min({p.dot(q), q.dot(r), r.dot(p)}) < 0.4) continue;
        const bool outward = p.dot(q.cross(r)) > 0;
        const auto vertex = [&](int i, int j) {
          const Vec3 sum = weight(frequency - i - j) * p + weight(i) * q + weight(j) * r;
          return welder.index(sum.normalized());
        };
        const auto add = [&](int u, int v, int w) {
          if (!outward) std::swap(v, w);
          welder.mesh.triangles.push_back({u, v, w});
        };
        for (int i = 0; i < frequency; ++i)
          for (int j = 0; i + j < frequency; ++j) {
            add(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
            if (i + j + 2 <= frequency)
              add(vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
          }
      }
  return welder.mesh;
}

/// Coefficients of z = (R/2) sqrt(1 - x^2) (a0 + a1 x^2 + a2 x^4), x = r/R.
struct Profile {
  double a0 = 0.207, a1 = 2.002, a2 = -1.122;
};

/// Biconcave disc of unit radius; its vertices have the distance from the axis that they have on
/// the sphere.
inline Mesh disc(int frequency, const Profile &profile = {})
{
  Mesh mesh = icosphere(frequency);
  for (Vec3 &x : mesh.vertices) {
    const double square = x[0] * x[0] + x[1] * x[1];
    x[2] *= 0.5 * (profile.a0 + square * (profile.a1 + square * profile.a2));
  }
  return mesh;
}

/// The smooth disc where it is `angle` from the pole of the sphere it was made from: r =
/// sin(angle).
struct SmoothDisc {
  Profile profile;

  struct Curvature {
    double mean, gaussian;    ///< positive on a sphere
    double arc;               ///< arc length of the profile per angle
  };

  Curvature curvature(double angle) const
  {
    const double s = std::sin(angle), c = std::cos(angle), q = s * s, dq = 2 * s * c,
                 ddq = 2 * (c * c - s * s);
    const double g = 0.5 * (profile.a0 + q * (profile.a1 + q * profile.a2));
    const double dg = 0.5 * (profile.a1 + 2 * q * profile.a2) * dq;
    const double ddg = profile.a2 * dq * dq + 0.5 * (profile.a1 + 2 * q * profile.a2) * ddq;
    const double dz = -s * g + c * dg, ddz = -c * g - 2 * s * dg + c * ddg;
    const double arc = std::hypot(c, dz);
    const double along = -(c * ddz + s * dz) / (arc * arc * arc);
    const double around = std::abs(s) > 1e-9 ? -dz / (arc * s) : along;
    return {(along + around) / 2, along * around, arc};
  }

  /// Outward normal force per area for kappa = 1 and c0 = 0, 2 (lapl H + 2 H (H^2 - K)) (Zhong-can
  /// and Helfrich, Phys. Rev. A 39 (1989) 5280), with the Laplacian by finite differences of fourth
  /// order.
  double bending_force(double angle) const
  {
    const double step = 2e-3;
    angle = std::max(angle, step);    // the force is level at the poles
    const auto derivative = [&](const auto &f, double at) {
      return (8 * (f(at + step) - f(at - step)) - (f(at + 2 * step) - f(at - 2 * step))) /
             (12 * step);
    };
    const auto mean = [&](double at) { return curvature(at).mean; };
    const auto flux = [&](double at) {
      return std::sin(at) / curvature(at).arc * derivative(mean, at);
    };
    const auto [H, K, arc] = curvature(angle);
    return 2 * (derivative(flux, angle) / (std::sin(angle) * arc) + 2 * H * (H * H - K));
  }
};

/// Cuboid from the origin, each face in n x n rectangles cut in two.
inline Mesh cuboid(const Vec3 &size, int n)
{
  Welder welder;
  for (int d = 0; d < 3; ++d)
    for (int side : {0, 1})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto vertex = [&](int di, int dj) {
            Vec3 s;
            s[d] = side;
            s[(d + 1) % 3] = double(i + di) / n;
            s[(d + 2) % 3] = double(j + dj) / n;
            return welder.index(s.cwiseProduct(size));
          };
          int corners[4] = {vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)};
          if (side == 0) std::swap(corners[1], corners[3]);
          welder.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
          welder.mesh.triangles.push_back({corners[0], corners[2], corners[3]});
        }
  return welder.mesh;
}

/// By the corners' shares of the stress-free triangles.
inline std::vector<double> vertex_areas(const rbc::SurfaceTemplate &shape)
{
  std::vector<double> areas(shape.vertex_count());
  for (std::size_t t = 0; t < shape.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      areas[shape.triangles[t][c]] += shape.corner_share[c][t] * shape.reference[t].area;
  return areas;
}

// ---- random values

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double between(double lo, double hi) { return lo + (hi - lo) * (engine_() / 4294967296.0); }
  int below(int n) { return static_cast<int>(engine_() % n); }
  Vec3 vector(double lo, double hi)
  {
    Vec3 v;
    for (int d = 0; d < 3; ++d) v[d] = between(lo, hi);
    return v;
  }
  Vec3 direction()
  {
    for (;;) {
      const Vec3 v = vector(-1, 1);
      if (v.norm() < 1 && v.norm() > 0.1) return v.normalized();
    }
  }
  Matrix3 rotation() { return Eigen::AngleAxisd(between(0.5, 3), direction()).toRotationMatrix(); }

 private:
  std::mt19937 engine_;
};

/// Grown by a tenth and moved by long random waves: a smooth deformation of a cell of unit size
/// with strains of some 20 %.
inline Vertices waved(const Vertices &x, unsigned seed)
{
  Random random(seed);
  Vertices y = transformed(x, [](const Vec3 &v) { return Vec3(1.1 * v); });
  for (int wave = 0; wave < 6; ++wave) {
    const Vec3 amplitude = random.vector(-0.07, 0.07), k = random.vector(-2, 2);
    const double phase = random.between(0, 2 * pi);
    for (std::size_t v = 0; v < x.size(); ++v) y[v] += std::sin(k.dot(x[v]) + phase) * amplitude;
  }
  return y;
}

// ---- vectors

/// Sum of sizes, the scale of round-off in sums of vectors.
inline double total_norm(const Vertices &vectors)
{
  double sum = 0;
  for (const Vec3 &v : vectors) sum += v.norm();
  return sum;
}

inline double largest_difference(const Vertices &a, const Vertices &b)
{
  double largest = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t v = 0; v < std::min(a.size(), b.size()); ++v) {
    const double difference = (a[v] - b[v]).norm();
    largest = std::isnan(difference) ? HUGE_VAL : std::max(largest, difference);
  }
  return largest;
}

// ---- closest points

inline rbc::PlainVector plain(const Vec3 &v)
{
  return {v[0], v[1], v[2]};
}

/// Point of a triangle closest to x: of its plane if inside, else of the closest edge.
inline Vec3 closest_point(const Vec3 &x, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const Vec3 corner[3] = {a, b, c};
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const Vec3 foot = x - normal.dot(x - a) * normal;
  bool inside = true;
  for (int e = 0; e < 3; ++e) {
    const Vec3 &from = corner[e], &to = corner[(e + 1) % 3];
    inside = inside && (to - from).cross(foot - from).dot(normal) >= 0;
  }
  if (inside) return foot;
  Vec3 best = a;
  for (int e = 0; e < 3; ++e) {
    const Vec3 &from = corner[e], edge = corner[(e + 1) % 3] - from;
    const double along = std::clamp(edge.dot(x - from) / edge.squaredNorm(), 0.0, 1.0);
    const Vec3 point = from + along * edge;
    if ((x - point).norm() < (x - best).norm()) best = point;
  }
  return best;
}

/// Solid angle of the triangle from x over 4 pi, positive from inside (Van Oosterom and Strackee
/// 1983).
inline double winding(const Vec3 &x, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const Vec3 r = a - x, s = b - x, t = c - x;
  const double l = r.norm(), m = s.norm(), n = t.norm();
  return std::atan2(r.dot(s.cross(t)), l * m * n + r.dot(s) * n + s.dot(t) * l + t.dot(r) * m) /
         (2 * pi);
}

// ---- orders and tables

/// Of an error that falls while the frequency of the mesh doubles.
inline double order(double coarse, double fine)
{
  return std::log2(std::abs(coarse / fine));
}

/// Rows of a comma-separated file below its comments; the name counts from the folder tests/.
class Table {
 public:
  explicit Table(const std::string &name)
  {
    std::ifstream file(std::filesystem::path(TEST_FOLDER) / name);
    std::string line;
    while (std::getline(file, line)) {
      if (line.empty() || line[0] == '#') continue;
      std::vector<std::string> words;
      std::istringstream stream(line);
      for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
      if (columns_.empty())
        for (std::size_t c = 0; c < words.size(); ++c) columns_[words[c]] = c;
      else
        rows_.push_back(words);
    }
    EXPECT_GT(rows(), 0) << "no table " << name;
  }

  int rows() const { return static_cast<int>(rows_.size()); }
  const std::string &text(int row, const std::string &column) const
  {
    return rows_[row][columns_.at(column)];
  }
  double number(int row, const std::string &column) const { return std::stod(text(row, column)); }

 private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}    // namespace test
