// Closed surfaces: what is refused, and area, volume and curvature of those that are accepted.

#include "test_support.h"

#include <iostream>
#include <stdexcept>

using namespace test;

namespace {

Mesh octahedron()
{
  return {{{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

void expect_refused(const Mesh &mesh, const std::string &reason)
{
  try {
    mesh.surface();
    FAIL() << "accepted, though it should say: " << reason;
  } catch (const std::invalid_argument &problem) {
    EXPECT_NE(std::string(problem.what()).find(reason), std::string::npos) << problem.what();
  }
}

/// Another surface added, whose vertices are those in `joint` where given, or else new ones.
Mesh with(const Mesh &mesh, const Mesh &other, const std::map<int, int> &joint = {})
{
  Mesh both = mesh;
  std::vector<int> index;
  for (std::size_t v = 0; v < other.vertices.size(); ++v) {
    const auto old = joint.find(static_cast<int>(v));
    index.push_back(old != joint.end() ? old->second : static_cast<int>(both.vertices.size()));
    if (old == joint.end()) both.vertices.push_back(other.vertices[v] + Vec3(9, 0, 0));
  }
  for (const auto &[i, j, k] : other.triangles)
    both.triangles.push_back({index[i], index[j], index[k]});
  return both;
}

TEST(Template, OctahedronIsAccepted)
{
  const rbc::SurfaceTemplate shape = octahedron().surface();
  EXPECT_EQ(shape.vertex_count(), 6);
  EXPECT_EQ(shape.hinges.size(), 12u);
  EXPECT_NEAR(shape.area, 16 * std::sqrt(3), 1e-13);
  EXPECT_NEAR(shape.volume, 32.0 / 3, 1e-14);
  EXPECT_NEAR(shape.longest_edge, std::sqrt(8), 1e-15);
  EXPECT_NEAR(shape.mean_edge, std::sqrt(8), 1e-14);
  for (int v = 0; v < 6; ++v) {
    EXPECT_EQ(shape.neighbors[v].size(), 4u);
    EXPECT_EQ(shape.incident_triangles[v].size(), 4u);
    // Four edges with normals at acos(1/3), over a third of four faces: l theta / A.
    EXPECT_NEAR(shape.curvature[v], std::sqrt(8) * std::acos(1.0 / 3) / (8 / std::sqrt(3)), 1e-14);
  }
}

TEST(Template, HingesSeeTheirTrianglesFromOutside)
{
  const rbc::SurfaceTemplate shape = disc(4).surface();
  EXPECT_EQ(shape.hinges.size(), shape.triangles.size() * 3 / 2);
  const auto turns = [&](int triangle, int a, int b, int c) {
    const auto &[i, j, k] = shape.triangles[triangle];
    return (i == a && j == b && k == c) || (j == a && k == b && i == c) ||
           (k == a && i == b && j == c);
  };
  for (const rbc::Hinge &hinge : shape.hinges) {
    EXPECT_TRUE(turns(hinge.left, hinge.a, hinge.b, hinge.c));
    EXPECT_TRUE(turns(hinge.right, hinge.b, hinge.a, hinge.d));
  }
}

TEST(Template, OpenSurfaceIsRefused)
{
  Mesh mesh = octahedron();
  mesh.triangles.erase(mesh.triangles.begin() + 3);
  expect_refused(mesh, "not closed");
}

TEST(Template, TooFewTrianglesAreRefused)
{
  Mesh mesh = octahedron();
  mesh.triangles.resize(3);
  expect_refused(mesh, "at least 4 triangles");
  mesh.triangles.clear();
  expect_refused(mesh, "at least 4 triangles");
}

TEST(Template, FlippedTriangleIsRefused)
{
  Mesh mesh = octahedron();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  expect_refused(mesh, "not consistently oriented");
}

TEST(Template, TriangleGivenTwiceIsRefused)
{
  Mesh mesh = octahedron();
  mesh.triangles.push_back(mesh.triangles[2]);
  expect_refused(mesh, "not consistently oriented");
}

TEST(Template, InwardOrientationIsRefused)
{
  Mesh mesh = octahedron();
  for (auto &triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  expect_refused(mesh, "oriented inward");
}

TEST(Template, UnusedVertexIsRefused)
{
  Mesh mesh = octahedron();
  mesh.vertices.push_back({1, 2, 3});
  expect_refused(mesh, "vertex 7 belongs to no triangle");
}

TEST(Template, TwoPiecesAreRefused)
{
  expect_refused(with(octahedron(), octahedron()), "more than one piece");
}

TEST(Template, SurfacesThatTouchInAVertexAreRefused)
{
  expect_refused(with(octahedron(), octahedron(), {{1, 0}}), "not a sphere");
  // Two common vertices: vertices - edges + triangles is that of a sphere.
  expect_refused(with(octahedron(), octahedron(), {{1, 0}, {0, 1}}), "vertex 1");
}

TEST(Template, TorusIsRefused)
{
  Mesh mesh;
  const int n = 6;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2 * pi * i / n, v = 2 * pi * j / n;
      mesh.vertices.push_back(
          {(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
      const int a = n * i + j, b = n * ((i + 1) % n) + j, c = n * ((i + 1) % n) + (j + 1) % n,
                d = n * i + (j + 1) % n;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  expect_refused(mesh, "not a sphere");
}

TEST(Template, TriangleWithoutAreaIsRefused)
{
  Mesh mesh = octahedron();
  mesh.vertices[4] = {1, 1, 0};    // on the edge between the first and the third
  expect_refused(mesh, "triangle 1 has no area");
  mesh.vertices[4] = mesh.vertices[0];
  expect_refused(mesh, "has no area");
  mesh.vertices[4][1] = std::nan("");
  expect_refused(mesh, "has no area");
}

TEST(Template, WhatRoundingLeavesNothingOfIsRefused)
{
  Mesh mesh = octahedron();
  for (const double height : {1e-5, 1e-7}) {    // of the triangles above an edge
    mesh.vertices[4] = Vec3(1, 1, 0) + height * Vec3(1, 1, 1);
    if (height > 1e-6)
      EXPECT_NO_THROW(rbc::SurfaceTemplate(mesh.vertices, mesh.triangles));
    else
      expect_refused(mesh, "has no area");
  }
  mesh.vertices[4] = {0, 0, 1e61};
  expect_refused(mesh, "vertex 5 is too far away");
  mesh = octahedron();
  for (Vec3 &x : mesh.vertices) x *= 1e-90;
  expect_refused(mesh, "has no area");
}

TEST(Template, MissingVertexIsRefused)
{
  for (int missing : {-1, 6}) {
    Mesh mesh = octahedron();
    mesh.triangles[2][1] = missing;
    expect_refused(mesh, "triangle 3 names a vertex that does not exist");
  }
}

TEST(Template, VertexUsedTwiceByATriangleIsRefused)
{
  Mesh mesh = octahedron();
  mesh.triangles[7][2] = mesh.triangles[7][1];
  expect_refused(mesh, "triangle 8 uses a vertex twice");
}

TEST(Template, SphereHasSecondOrderAreaAndVolume)
{
  const double radius = 3.7, area = 4 * pi * radius * radius, volume = area * radius / 3;
  std::array<double, 2> last{};
  for (int frequency : {4, 8, 16, 32}) {
    Mesh mesh = icosphere(frequency);
    mesh.vertices = transformed(mesh.vertices,
                                [&](const Vec3 &x) { return Vec3(radius * x + Vec3(5, -2, 1)); });
    const rbc::SurfaceTemplate shape = mesh.surface();
    ASSERT_EQ(shape.vertex_count(), 10 * frequency * frequency + 2);
    const std::array<double, 2> error{1 - shape.area / area, 1 - shape.volume / volume};
    for (int i = 0; i < 2; ++i)
      if (frequency > 4) {
        EXPECT_NEAR(order(last[i], error[i]), 2, 0.03);
      }
    last = error;
  }
  EXPECT_LT(last[1], 1.5e-3);
}

/// Largest relative error of the curvature, and its integral.
struct SphereCurvature {
  double error = 0, integral = 0;

  SphereCurvature(int frequency, double radius)
  {
    Mesh mesh = icosphere(frequency);
    for (Vec3 &x : mesh.vertices) x *= radius;
    const rbc::SurfaceTemplate shape = mesh.surface();
    const std::vector<double> areas = vertex_areas(shape);
    for (int v = 0; v < shape.vertex_count(); ++v) {
      integral += areas[v] * shape.curvature[v];
      error = std::max(error, std::abs(radius * shape.curvature[v] - 1));
    }
  }
};

TEST(Template, IntegralOfTheCurvatureOfASphereIsOfSecondOrder)
{
  const double radius = 0.3;
  double last = 0;
  for (int frequency : {4, 8, 16, 32}) {
    const double error = SphereCurvature(frequency, radius).integral / (4 * pi * radius) - 1;
    if (frequency > 4) {
      EXPECT_NEAR(order(last, error), 2, 0.02);
    }
    last = error;
  }
  EXPECT_LT(std::abs(last), 1e-3);
}

TEST(Template, CurvatureOfASphereConvergesAtEveryVertex)
{
  double last = 0;
  for (int frequency : {4, 8, 16, 32}) {
    const double error = SphereCurvature(frequency, 2.5).error;
    if (frequency > 4) {
      EXPECT_NEAR(order(last, error), 2, 0.1);
    }
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

double distance(const Vec3 &a, const Vec3 &b)
{
  return (a - b).norm();
}

TEST(Template, CornersShareATriangleByTheNearestPointOrHaveTheMiddlesOfAnObtuseOnesSides)
{
  Random random(6);
  int acute = 0, obtuse = 0;
  for (int n = 0; n < 60; ++n) {
    // A tetrahedron, right-handed outward
    Mesh mesh{{random.vector(0, 1), random.vector(0, 1), random.vector(0, 1), random.vector(0, 1)},
              {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
    const Vertices &x = mesh.vertices;
    if ((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) > 0)
      std::swap(mesh.vertices[0], mesh.vertices[1]);
    const rbc::SurfaceTemplate shape = mesh.surface();
    for (std::size_t t = 0; t < 4; ++t) {
      const Vec3 corner[3] = {x[shape.triangles[t][0]], x[shape.triangles[t][1]],
                              x[shape.triangles[t][2]]};
      // Shares by counting points on a fine grid of the triangle
      const int count = 300;
      double near[3] = {0, 0, 0}, all = 0, widest = 0;
      for (int i = 0; i < count; ++i)
        for (int j = 0; i + j < count; ++j) {
          const double u = (i + 1.0 / 3) / count, v = (j + 1.0 / 3) / count;
          const Vec3 p = corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
          int c = 0;
          for (int other : {1, 2})
            if (distance(p, corner[other]) < distance(p, corner[c])) c = other;
          near[c] += 1;
          all += 1;
        }
      int tip = 0;
      for (int c = 0; c < 3; ++c) {
        const Vec3 e1 = corner[(c + 1) % 3] - corner[c], e2 = corner[(c + 2) % 3] - corner[c];
        const double angle = std::atan2(e1.cross(e2).norm(), e1.dot(e2));
        if (angle > widest) {
          widest = angle;
          tip = c;
        }
      }
      ++(widest > pi / 2 ? obtuse : acute);
      for (int c = 0; c < 3; ++c) {
        const double share = shape.corner_share[c][t];
        if (widest > pi / 2)
          EXPECT_EQ(share, c == tip ? 0.5 : 0.25);
        else
          EXPECT_NEAR(share, near[c] / all, 0.02);
      }
      EXPECT_NEAR(shape.corner_share[0][t] + shape.corner_share[1][t] + shape.corner_share[2][t], 1,
                  1e-14);
    }
  }
  EXPECT_GT(std::min(acute, obtuse), 20);
}

TEST(Template, CurvatureOfTheDiscIsOfSecondOrderAlmostEverywhere)
{
  double last = 0;
  for (int frequency : {8, 16, 32}) {
    const Mesh mesh = disc(frequency);
    const rbc::SurfaceTemplate shape = mesh.surface();
    const std::vector<double> areas = vertex_areas(shape);
    double error = 0;
    for (int v = 0; v < shape.vertex_count(); ++v) {
      if (shape.neighbors[v].size() == 5) continue;
      const double angle = std::asin(std::min(1.0, shape.vertices[v].head<2>().norm()));
      error += areas[v] * std::pow(shape.curvature[v] - SmoothDisc().curvature(angle).mean, 2);
    }
    error = std::sqrt(error / shape.area);
    std::cout << "rms error of the curvature, frequency " << frequency << ": " << error << '\n';
    if (frequency > 8) {
      EXPECT_GT(order(last, error), 1.7);
    }
    last = error;
  }
  EXPECT_LT(last, 4e-3);
}

}    // namespace
