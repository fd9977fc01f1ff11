// Laplacian and filter on surfaces: spherical harmonics, for which both are known.

#include "geometry/surface_filter.h"
#include "test_support.h"

using namespace test;
using rbc::MeshLaplacian;
using rbc::SurfaceFilter;
using Row = SurfaceFilter::Row;

namespace {

/// A zonal harmonic of degree 1, 2 or 4 about an axis without symmetry.
double harmonic(int degree, const Vec3 &x)
{
  const double z = x.normalized().dot(Vec3(0.3, -0.5, 0.8).normalized()), z2 = z * z;
  return degree == 1 ? z : degree == 2 ? 1.5 * z2 - 0.5 : (35 * z2 * z2 - 30 * z2 + 3) / 8;
}

std::vector<Row> on_vertices(const rbc::SurfaceTemplate &surface, int degree)
{
  std::vector<Row> values;
  for (const Vec3 &x : surface.vertices) {
    const double value = harmonic(degree, x);
    values.push_back({value, -2 * value, 1 + value, 0});
  }
  return values;
}

std::vector<Row> random_values(std::size_t count, unsigned seed)
{
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<Row> values;
  for (std::size_t n = 0; n < count; ++n)
    values.push_back({normal(generator), normal(generator), normal(generator), 0});
  return values;
}

double product(const SurfaceFilter &filter, const std::vector<Row> &a, const std::vector<Row> &b)
{
  double sum = 0;
  for (int v = 0; v < filter.vertex_count(); ++v) sum += filter.area(v) * (a[v] * b[v]).sum();
  return sum;
}

std::vector<Row> filtered(const SurfaceFilter &filter, std::vector<Row> values)
{
  std::vector<Row> scratch(values.size(), Row::Zero());
  filter.apply(values, scratch);
  return values;
}

rbc::SurfaceTemplate sphere(int frequency, double radius)
{
  Mesh mesh = icosphere(frequency);
  mesh.vertices =
      transformed(mesh.vertices, [radius](const Vec3 &x) -> Vec3 { return radius * x; });
  return mesh.surface();
}

/// Error of the Laplacian of a harmonic in the mean, over its eigenvalue -l (l + 1) / radius^2.
double laplacian_error(int frequency, int degree)
{
  constexpr double radius = 3;
  const auto surface = sphere(frequency, radius);
  const MeshLaplacian laplacian(surface);
  const auto values = on_vertices(surface, degree);
  double along = 0, square = 0;
  for (int v = 0; v < surface.vertex_count(); ++v) {
    const Row result = laplacian.at(v, [&values](int w) -> Row { return values[w]; });
    along += surface.vertex_area[v] * result[0] * values[v][0];
    square += surface.vertex_area[v] * values[v][0] * values[v][0];
  }
  const double exact = -degree * (degree + 1) / (radius * radius);
  return std::abs(along / square / exact - 1);
}

TEST(MeshLaplacian, OfHarmonicsConvergesAtSecondOrder)
{
  EXPECT_LT(laplacian_error(6, 1), 1e-10);    // exact on a mesh whose corners are on a sphere
  for (int degree : {2, 4}) {
    const double coarse = laplacian_error(6, degree), fine = laplacian_error(12, degree);
    std::printf("degree %d: %.5f, %.5f\n", degree, coarse, fine);
    EXPECT_LT(coarse, 0.012 * degree);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
  }
}

TEST(MeshLaplacian, BoundsItsEigenvalues)
{
  const auto surface = disc(8).surface();
  const MeshLaplacian laplacian(surface);
  auto values = random_values(surface.vertices.size(), 1);
  double largest = 0;
  for (int n = 0; n < 200; ++n) {
    auto next = values;
    double square = 0;
    for (int v = 0; v < surface.vertex_count(); ++v) {
      next[v] = laplacian.at(v, [&values](int w) -> Row { return values[w]; });
      square += next[v].square().sum();
    }
    largest = std::sqrt(square);
    for (Row &row : next) row /= largest;
    values = next;
  }
  EXPECT_LE(largest, laplacian.largest());
  EXPECT_GT(largest, 0.5 * laplacian.largest());
}

TEST(SurfaceFilter, IsSymmetric)
{
  const auto surface = disc(8).surface();
  const SurfaceFilter filter(surface, 4);
  const auto a = random_values(surface.vertices.size(), 2);
  const auto b = random_values(surface.vertices.size(), 3);
  const double ab = product(filter, a, filtered(filter, b));
  EXPECT_NEAR(product(filter, filtered(filter, a), b), ab, 1e-12 * std::abs(ab));
  const double aa = product(filter, a, filtered(filter, a));
  EXPECT_GT(aa, 0);
  EXPECT_LT(aa, product(filter, a, a));
}

/// Motions of a rigid body, and linear flows around it.
TEST(SurfaceFilter, KeepsLinearFunctionsOfTheCoordinates)
{
  const auto surface = disc(6).surface();
  const SurfaceFilter filter(surface, 1.5);
  const Eigen::Matrix3d gradient = Eigen::Matrix3d::Random();
  std::vector<Row> values;
  for (const Vec3 &x : surface.vertices) {
    const Vec3 value = gradient * x + Vec3(3, -1, 2);
    values.push_back({value[0], value[1], value[2], 0});
  }
  const auto after = filtered(filter, values);
  for (std::size_t v = 0; v < values.size(); ++v)
    EXPECT_LT((after[v] - values[v]).abs().maxCoeff(), 1e-13);
}

/// What it leaves of a harmonic is exp(-s) (1 + s), s = 1.678 l (l + 1) / (radius k)^2, for meshes
/// much finer than 1 / k.
TEST(SurfaceFilter, DampsHarmonicsAsItSays)
{
  constexpr double radius = 2, k = 2;
  const auto surface = sphere(12, radius);
  const SurfaceFilter filter(surface, k);
  EXPECT_GT(filter.passes(), 10);
  for (int degree : {2, 4}) {
    const auto values = on_vertices(surface, degree);
    const double left =
        product(filter, values, filtered(filter, values)) / product(filter, values, values);
    const double s = 1.678 * degree * (degree + 1) / (radius * radius * k * k);
    // The constant in the third column is kept. The mean square of a harmonic is 1 / (2 l + 1).
    const double harmonics = 6.0 / (2 * degree + 1);
    const double expected = (1 + harmonics * std::exp(-s) * (1 + s)) / (1 + harmonics);
    std::printf("degree %d: %.4f left, %.4f by the formula\n", degree, left, expected);
    EXPECT_NEAR(left, expected, 0.02);
  }
}

/// On a mesh as coarse as 1 / k little is left of what changes from vertex to vertex.
TEST(SurfaceFilter, DampsNoise)
{
  const auto surface = sphere(6, 6);    // edges of about 1.1
  const SurfaceFilter filter(surface, 2);
  const auto noise = random_values(surface.vertices.size(), 4);
  const auto after = filtered(filter, noise);
  EXPECT_LT(product(filter, after, after), 0.5 * product(filter, noise, noise));
}

}    // namespace
