#include "packing/cell_approach.h"

namespace rbc {

namespace {

constexpr double largest_slope =
    1.5;    // of the distance field: 1 but for its error, sqrt 2 beyond its grid
constexpr int search_steps = 4;

/// Coordinates of the probe's template in those of the body's.
struct Relative {
  Eigen::Matrix3d rotation;
  Vec3 shift;

  Relative(const RigidCell &probe, const RigidCell &body) :
      rotation(body.rotation.transpose() * probe.rotation), shift(body.body(probe.centre))
  {
  }
};

struct Seen {
  Vec3 place;
  DistanceField::Sample sample;
};

bool may_dip_below(double limit, double length, const Seen &a, const Seen &b)
{
  return a.sample.distance + b.sample.distance - largest_slope * length < 2 * limit;
}

/// Looks for a point of the edge that is nearer than both its ends, where the distance stops to
/// fall.
bool find_dip(const DistanceField &field, const Seen &a, const Seen &b, Seen &dip)
{
  const Vec3 along = b.place - a.place;
  double low = 0, high = 1, fall = a.sample.gradient.dot(along),
         rise = b.sample.gradient.dot(along);
  if (fall >= 0 || rise <= 0) return false;
  for (int step = 0; step < search_steps; ++step) {
    const double t = low + (high - low) * std::clamp(fall / (fall - rise), 0.1, 0.9);
    dip.place = a.place + t * along;
    dip.sample = field.at(dip.place);
    const double slope = dip.sample.gradient.dot(along);
    if (slope < 0) {
      low = t;
      fall = slope;
    } else {
      high = t;
      rise = slope;
    }
  }
  return dip.sample.distance < std::min(a.sample.distance, b.sample.distance);
}

}    // namespace

CellApproach::CellApproach(const RigidCell &probe, const RigidCell &body, double reach)
{
  const Relative to_body(probe, body);
  const SurfaceTemplate &surface = probe.shape->surface;
  const DistanceField &field = body.shape->field;

  static thread_local std::vector<Seen> seen;
  seen.clear();
  bool near = false;
  for (const Vec3 &vertex : surface.vertices) {
    const Vec3 place = to_body.rotation * vertex + to_body.shift;
    seen.push_back({place, field.at(place)});
    near = near || seen.back().sample.distance < reach + largest_slope * surface.longest_edge / 2;
  }
  if (!near) return;

  std::vector<int> place_of(surface.vertex_count(), -1);
  const auto keep = [&](int v) {
    if (place_of[v] < 0) {
      place_of[v] = static_cast<int>(vertices_.size());
      vertices_.push_back(v);
    }
    return place_of[v];
  };
  for (int v = 0; v < surface.vertex_count(); ++v)
    if (seen[v].sample.distance < reach) keep(v);
  for (const Hinge &edge : surface.hinges) {
    const Seen &a = seen[edge.a], &b = seen[edge.b];
    if (!may_dip_below(reach, (b.place - a.place).norm(), a, b)) continue;
    Seen dip;
    if (std::min(a.sample.distance, b.sample.distance) < reach ||
        (find_dip(field, a, b, dip) && dip.sample.distance < reach)) {
      const int first = keep(edge.a);
      edges_.push_back({first, keep(edge.b)});
    }
  }
}

void CellApproach::push(const RigidCell &probe, const RigidCell &body, double clearance,
                        Wrench &push) const
{
  const Relative to_body(probe, body);
  const SurfaceTemplate &surface = probe.shape->surface;
  const DistanceField &field = body.shape->field;

  Wrench in_body;
  const auto act = [&](const Seen &point) {
    const double depth = clearance - point.sample.distance;
    if (depth > 0) in_body.add(point.place - to_body.shift, depth * point.sample.gradient, depth);
  };

  static thread_local std::vector<Seen> seen;
  seen.clear();
  for (int v : vertices_) {
    const Vec3 place = to_body.rotation * surface.vertices[v] + to_body.shift;
    seen.push_back({place, field.at(place)});
    act(seen.back());
  }
  for (const Edge &edge : edges_) {
    const Seen &a = seen[edge.a], &b = seen[edge.b];
    Seen dip;
    if (may_dip_below(clearance, (b.place - a.place).norm(), a, b) && find_dip(field, a, b, dip))
      act(dip);
  }
  push.force += body.rotation * in_body.force;
  push.torque += body.rotation * in_body.torque;
  push.overlap = std::max(push.overlap, in_body.overlap);
}

}    // namespace rbc
