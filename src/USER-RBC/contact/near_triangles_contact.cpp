#include "contact/near_triangles.h"

#include "geometry/arc_tangent.h"
#include "geometry/closest_point.h"
#include "geometry/signed_distance.h"

namespace rbc {

namespace {

// distance over an edge's length below which the line to a point has no direction

constexpr double TOUCHING = 1e-10;

}    // namespace

/* ----------------------------------------------------------------------
   On the straight way from where all were when built to where they are now the point has not met
   the surface, so that it winds around the point as it did. A point that is on the surface itself
   is on the side of the triangle that is nearest now.
------------------------------------------------------------------------- */

bool NearTriangles::has_kept_side(const Group &group) const
{
  const Triangle &nearest = (*triangles_)[candidates_.triangle[group.nearest]];
  return nearest.surface != surfaces_[group.point] &&
         group.distance > held_distance(0, motion_.around(group.point));
}

void NearTriangles::add_contact(const double *x, Group &group)
{
  const PlainVector p = at(x, group.point);
  const std::array<int, 3> &corner = (*triangles_)[candidates_.triangle[group.nearest]].corner;
  const PlainVector a = at(x, corner[0]), b = at(x, corner[1]), c = at(x, corner[2]);
  const auto weight = closest_point_weights(p, a, b, c);
  const PlainVector apart = p - weighted_point(weight, a, b, c), face = cross(b - a, c - a);
  const double distance = norm(apart);
  const bool side_is_kept = has_kept_side(group);
  const bool inside = side_is_kept && group.side != Side::unknown
                          ? group.side == Side::inside
                          : is_inside(x, corner, weight, face, apart);
  if (side_is_kept) group.side = inside ? Side::inside : Side::outside;
  const auto direction = [&] {
    if (distance > TOUCHING * norm(b - a)) return (inside ? -1 / distance : 1 / distance) * apart;
    const PlainVector out = outward(x, corner, weight, face);
    return (1 / norm(out)) * out;
  };
  push_back_tightly(contacts_, VertexContact{group.point, corner, weight, direction(),
                                             inside ? -distance : distance});
}

/* ----------------------------------------------------------------------
   calls f(edge to the next corner, edge to the last one) for each triangle around the edge or the
   corner on which the closest point is
------------------------------------------------------------------------- */

template <typename Function>
void NearTriangles::visit_around(const double *x, const std::array<int, 3> &corner,
                                 const TriangleFeature &feature, const Function &f) const
{
  const int on[2] = {corner[feature.corner[0]],
                     feature.count == 2 ? corner[feature.corner[1]] : -1};
  for (int n = around_.begin[on[0]]; n < around_.begin[on[0] + 1]; ++n) {
    const std::array<int, 3> &around = (*triangles_)[around_.number[n]].corner;
    const int place = on[0] == around[0] ? 0 : on[0] == around[1] ? 1 : 2;
    const int next = around[(place + 1) % 3], last = around[(place + 2) % 3];
    if (feature.count == 2 && next != on[1] && last != on[1]) continue;
    f(at(x, next) - at(x, on[0]), at(x, last) - at(x, on[0]));
  }
}

/* ----------------------------------------------------------------------
   The outward direction is a sum of normals with positive weights, which need not be known where
   all of these normals are on one side.
------------------------------------------------------------------------- */

bool NearTriangles::is_inside(const double *x, const std::array<int, 3> &corner,
                              const std::array<double, 3> &weight, PlainVector face,
                              PlainVector apart) const
{
  const TriangleFeature feature(weight);
  if (feature.count == 3) return dot(apart, face) < 0;
  bool above = false, below = false;
  visit_around(x, corner, feature, [&](PlainVector to_next, PlainVector to_last) {
    const double side = dot(apart, cross(to_next, to_last));
    above |= side > 0;
    below |= side < 0;
  });
  return above && below ? dot(apart, outward(x, corner, weight, face)) < 0 : below;
}

/* ----------------------------------------------------------------------
   direction at the closest point that points out of the surface, as FeatureNormals has it. Surfaces
   move from step to step, so that it is found only where it is needed.
------------------------------------------------------------------------- */

PlainVector NearTriangles::outward(const double *x, const std::array<int, 3> &corner,
                                   const std::array<double, 3> &weight, PlainVector face) const
{
  const TriangleFeature feature(weight);
  if (feature.count == 3) return face;
  PlainVector sum{0, 0, 0};
  visit_around(x, corner, feature, [&](PlainVector to_next, PlainVector to_last) {
    const PlainVector normal = cross(to_next, to_last);
    const double length = norm(normal);
    const double angle = feature.count == 2 ? 1 : arc_tangent(length, dot(to_next, to_last));
    sum = sum + (angle / length) * normal;
  });
  return sum;
}

}    // namespace rbc
