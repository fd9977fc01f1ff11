#include "packing/cell_placement.h"

#include "geometry/solid_angle.h"
#include "geometry/triangle_distance.h"
#include "packing/surface_gap.h"

#include <cmath>

namespace rbc {

namespace {

constexpr int most_centres = 1000;    // of a draw, until one lies in the enclosure

struct Bounds {
  Vec3 lo = Vec3::Constant(HUGE_VAL), hi = Vec3::Constant(-HUGE_VAL);

  void include(const Vec3 &x)
  {
    lo = lo.cwiseMin(x);
    hi = hi.cwiseMax(x);
  }
  bool near(const Bounds &other, double reach) const
  {
    return ((lo - other.hi).array() < reach).all() && ((other.lo - hi).array() < reach).all();
  }
};

struct BoundedTriangle {
  Triangle corners;
  Bounds bounds;
};

Bounds bounds_of(const std::vector<Vec3> &vertices)
{
  Bounds bounds;
  for (const Vec3 &vertex : vertices) bounds.include(vertex);
  return bounds;
}

/// The triangles that come near to what lies within bounds.
std::vector<BoundedTriangle> facing(const std::vector<Vec3> &vertices,
                                    const std::vector<SurfaceTemplate::Corners> &triangles,
                                    const Bounds &bounds, double reach)
{
  std::vector<BoundedTriangle> found;
  for (const auto &[i, j, k] : triangles) {
    BoundedTriangle triangle{{vertices[i], vertices[j], vertices[k]}, {}};
    for (const Vec3 &corner : triangle.corners) triangle.bounds.include(corner);
    if (triangle.bounds.near(bounds, reach)) found.push_back(triangle);
  }
  return found;
}

bool is_inside(const Vec3 &x, const CellPlacement::Surface &surface)
{
  double angle = 0;
  for (const auto &[i, j, k] : *surface.triangles)
    angle += solid_angle(surface.vertices[i] - x, surface.vertices[j] - x, surface.vertices[k] - x);
  return std::abs(angle) > 2 * M_PI;    // 4 pi inside, 0 outside
}

/// Neither nearer than the gap nor one inside the other.
bool are_apart(const CellPlacement::Surface &one, const CellPlacement::Surface &other, double gap)
{
  const Bounds here = bounds_of(one.vertices), there = bounds_of(other.vertices);
  if (!here.near(there, gap)) return true;
  const auto others = facing(other.vertices, *other.triangles, here, gap);
  for (const BoundedTriangle &own : facing(one.vertices, *one.triangles, there, gap))
    for (const BoundedTriangle &triangle : others)
      if (own.bounds.near(triangle.bounds, gap) && distance(own.corners, triangle.corners) < gap)
        return false;
  return !is_inside(one.vertices[0], other) && !is_inside(other.vertices[0], one);
}

bool is_off(const Vec3 &point, const CellPlacement::Surface &surface, double gap)
{
  for (const auto &[i, j, k] : *surface.triangles)
    if (squared_distance(point, {surface.vertices[i], surface.vertices[j], surface.vertices[k]}) <
        gap * gap)
      return false;
  return !is_inside(point, surface);
}

}    // namespace

CellPlacement::CellPlacement(const SurfaceTemplate &cell, double gap, unsigned seed) :
    shape_(cell, gap), gap_(gap), seed_(seed)
{
}

void CellPlacement::confine(const Enclosure &enclosure, const Vec3 &lo, const Vec3 &length)
{
  enclosure_ = &enclosure;
  lo_ = lo;
  length_ = length;
}

void CellPlacement::clear()
{
  placed_.clear();
  points_.clear();
}

CellPlacement::Placed::Placed(Surface surface_in, double row_in) :
    surface(std::move(surface_in)), centre(Vec3::Zero()), radius(0), row(row_in)
{
  for (const Vec3 &vertex : surface.vertices) centre += vertex;
  centre /= static_cast<double>(surface.vertices.size());
  for (const Vec3 &vertex : surface.vertices) radius = std::max(radius, (vertex - centre).norm());
}

void CellPlacement::avoid_surface(Surface surface, double row)
{
  const std::size_t first = placed_.size();
  placed_.emplace_back(std::move(surface), row);
  for (const Vec3 &shift : images(placed_[first].centre, placed_[first].radius)) {
    Placed image = placed_[first];
    image.centre += shift;
    for (Vec3 &vertex : image.surface.vertices) vertex += shift;
    placed_.push_back(std::move(image));
  }
}

void CellPlacement::avoid_point(const Vec3 &point)
{
  points_.push_back(point);
  for (const Vec3 &shift : images(point, 0)) points_.push_back(point + shift);
}

/// Shifts to those images that may be in the way of a cell whose centre lies where cells appear.
std::vector<Vec3> CellPlacement::images(const Vec3 &centre, double radius) const
{
  const double far = radius + reach();
  const auto is_near = [&](const Vec3 &x) {
    return ((x - lo_).array() > -far).all() && ((x - lo_ - length_).array() < far).all();
  };
  std::vector<Vec3> shifts;
  for (int n = 0; n < 27; ++n) {
    const Vec3 way(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1), shift = way.cwiseProduct(period_);
    const bool goes = ((period_.array() > 0) || (way.array() == 0)).all();
    if (goes && n != 13 && is_near(centre + shift)) shifts.push_back(shift);
  }
  return shifts;
}

bool CellPlacement::fits(std::vector<Vec3> vertices, double gap, double row) const
{
  const Placed cell({std::move(vertices), &shape_.surface.triangles});
  for (const Vec3 &point : points_)
    if ((point - cell.centre).norm() < cell.radius + gap && !is_off(point, cell.surface, gap))
      return false;
  for (const Placed &other : placed_)
    if (other.row != row &&
        (other.centre - cell.centre).norm() < cell.radius + gap + other.radius &&
        !are_apart(cell.surface, other.surface, gap))
      return false;
  return true;
}

std::optional<CellPlacement::Place> CellPlacement::find(int draws)
{
  for (int n = 0; n < draws; ++n) {
    const std::optional<RigidCell> cell = draw(drawn_++);
    if (!cell || !fits(*cell)) continue;
    Surface surface{{}, &shape_.surface.triangles};
    for (int v = 0; v < shape_.surface.vertex_count(); ++v)
      surface.vertices.push_back(cell->vertex(v));
    avoid_surface(std::move(surface));
    return Place{cell->centre, cell->rotation};
  }
  return std::nullopt;
}

std::mt19937_64 CellPlacement::numbers(std::int64_t draw) const
{
  const auto bits = static_cast<std::uint64_t>(draw);
  std::seed_seq seeds{seed_, static_cast<unsigned>(bits), static_cast<unsigned>(bits >> 32)};
  return std::mt19937_64(seeds);
}

/// The centre is uniform in the enclosure, the direction uniform over all rotations (Shoemake,
/// Graphics Gems III, 1992).
std::optional<RigidCell> CellPlacement::draw(std::int64_t number) const
{
  std::mt19937_64 random = numbers(number);
  const auto uniform = [&random] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  for (int n = 0; n < most_centres; ++n) {
    Vec3 centre;
    for (int d = 0; d < 3; ++d) centre[d] = lo_[d] + uniform() * length_[d];
    if (enclosure_ && !enclosure_->contains(centre)) continue;
    const double share = uniform(), first = 2 * M_PI * uniform(), second = 2 * M_PI * uniform();
    const double a = std::sqrt(1 - share), b = std::sqrt(share);
    const Eigen::Quaterniond turn(b * std::cos(second), a * std::sin(first), a * std::cos(first),
                                  b * std::sin(second));
    return RigidCell{&shape_, centre, turn.toRotationMatrix(), 1};
  }
  return std::nullopt;
}

bool CellPlacement::fits(const RigidCell &cell) const
{
  Surface own{{}, &shape_.surface.triangles};
  for (int v = 0; v < shape_.surface.vertex_count(); ++v) {
    own.vertices.push_back(cell.vertex(v));
    if (enclosure_ && !enclosure_->contains(own.vertices.back())) return false;
  }
  for (const Vec3 &point : points_)
    if ((point - cell.centre).norm() < reach() && surface_gap(point, cell, gap_) < gap_)
      return false;
  for (const Placed &other : placed_)
    if ((other.centre - cell.centre).norm() < reach() + other.radius &&
        !is_clear(cell, own, other.surface))
      return false;
  return true;
}

/// The distance field, whose errors are small beside a gap, tells of most that do not fit.
bool CellPlacement::is_clear(const RigidCell &cell, const Surface &own, const Surface &other) const
{
  for (const Vec3 &vertex : other.vertices)
    if (shape_.field.at(cell.body(vertex)).distance < gap_) return false;
  return are_apart(own, other, gap_);
}

}    // namespace rbc
