#include "vessel/periodic_lids.h"

#include "vessel/mesh_connectivity.h"

#include <Eigen/Geometry>

namespace rbc {

namespace {

bool lies_on(const Triangle &triangle, int d, double face, double tolerance)
{
  for (const Vec3 &corner : triangle)
    if (!(std::abs(corner[d] - face) <= tolerance)) return false;
  const double area = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm() / 2;
  return area > tolerance * tolerance;
}

}    // namespace

std::array<Lids, 3> find_lids(const std::vector<Triangle> &triangles, const PackingBox &box)
{
  std::array<Lids, 3> lids;
  for (int d = 0; d < 3; ++d) {
    if (!box.periodic[d]) continue;
    const double tolerance = face_share * box.length[d];
    std::array<Eigen::AlignedBox3d, 2> extent;
    for (int side = 0; side < 2; ++side)
      for (const Triangle &triangle : triangles) {
        if (!lies_on(triangle, d, box.lo[d] + side * box.length[d], tolerance)) continue;
        ++lids[d].triangles[side];
        for (Vec3 corner : triangle) {
          corner[d] = 0;
          extent[side].extend(corner);
        }
      }
    lids[d].facing =
        lids[d].triangles[0] > 0 && lids[d].triangles[1] > 0 && extent[0].intersects(extent[1]);
  }
  return lids;
}

}    // namespace rbc
