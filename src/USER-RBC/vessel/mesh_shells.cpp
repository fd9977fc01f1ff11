#include "vessel/mesh_shells.h"

#include "geometry/solid_angle.h"
#include "vessel/mesh_connectivity.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace rbc {

namespace {

struct Shell {
  std::vector<int> triangles;
  Eigen::AlignedBox3d box;
  double volume = 0;    ///< below zero of a cavity
};

std::vector<Shell> find_shells(const std::vector<Triangle> &triangles, const MeshConnectivity &mesh)
{
  std::vector<Shell> shells;
  std::vector<char> seen(triangles.size());
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    Shell shell{{static_cast<int>(first)}, {}, 0};
    const Vec3 origin = triangles[first][0];
    for (std::size_t n = 0; n < shell.triangles.size(); ++n) {
      const int t = shell.triangles[n];
      const auto &[a, b, c] = triangles[t];
      for (const Vec3 &corner : triangles[t]) shell.box.extend(corner);
      shell.volume += (a - origin).dot((b - origin).cross(c - origin)) / 6;
      for (int edge = 0; edge < 3; ++edge) {
        const int next = mesh.neighbor(t, edge);
        if (!seen[next]) shell.triangles.push_back(next);
        seen[next] = 1;
      }
    }
    shells.push_back(std::move(shell));
  }
  return shells;
}

/// How often a shell goes around a point.
double winding(const Vec3 &x, const Shell &shell, const std::vector<Triangle> &triangles)
{
  if (!shell.box.contains(x)) return 0;
  double angle = 0;
  for (const int t : shell.triangles) {
    const auto &[a, b, c] = triangles[t];
    angle += solid_angle(a - x, b - x, c - x);
  }
  return angle / (4 * M_PI);
}

}    // namespace

void check_shells(const std::vector<Triangle> &triangles, const MeshConnectivity &mesh)
{
  const std::vector<Shell> shells = find_shells(triangles, mesh);
  for (const Shell &shell : shells) {
    const auto &[a, b, c] = triangles[shell.triangles[0]];
    const Vec3 x = (a + b + c) / 3;
    double others = 0;
    for (const Shell &other : shells)
      if (&other != &shell) others += winding(x, other, triangles);
    const long around = std::lround(others);
    if (around == (shell.volume > 0 ? 0 : 1)) continue;
    char place[80];
    std::snprintf(place, sizeof place, "(%.6g, %.6g, %.6g)", x[0], x[1], x[2]);
    throw std::invalid_argument(
        std::string("the closed surface on which ") + place + " lies " +
        (shell.volume > 0 ? "is within another one that is oriented alike: leave it out, or turn "
                            "its triangles if it bounds a cavity"
                          : "is oriented the other way than the rest, and bounds no cavity: turn "
                            "its triangles"));
  }
}

}    // namespace rbc
