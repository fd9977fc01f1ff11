#include "vessel/triangulated_solid.h"

#include "vessel/mesh_connectivity.h"
#include "vessel/mesh_shells.h"

#include <cmath>
#include <stdexcept>

namespace rbc {

namespace {

constexpr double most_cells = 150000;

Vec3 area_vector(const Triangle &t)
{
  return (t[1] - t[0]).cross(t[2] - t[0]) / 2;
}

}    // namespace

TriangulatedSolid::TriangulatedSolid(std::vector<Triangle> triangles, const PackingBox &box) :
    box_(box), triangles_(std::move(triangles))
{
  const MeshConnectivity mesh(triangles_, box_);
  box_.periodic = mesh.open();
  lo_ = hi_ = triangles_[0][0];
  for (const Triangle &triangle : triangles_)
    for (const Vec3 &corner : triangle) {
      lo_ = lo_.cwiseMin(corner);
      hi_ = hi_.cwiseMax(corner);
    }
  normals_ = feature_normals(
      triangles_, mesh.vertices(), [&mesh](int t, int c) { return mesh.vertex(t, c); },
      [&mesh](int t, int c) { return mesh.neighbor(t, c); });
  orient();
  if (mesh.open() == std::array<bool, 3>{}) check_shells(triangles_, mesh);
  index();
  measure_centres();
}

/* ----------------------------------------------------------------------
   outward, where there is an outside that is not all around
------------------------------------------------------------------------- */

void TriangulatedSolid::orient()
{
  int closed = 0;
  for (bool open : box_.periodic) closed += !open;
  if (closed == 0) {
    volume_ = box_.length.prod();
    return;
  }
  const Vec3 middle = (lo_ + hi_) / 2;
  for (const Triangle &t : triangles_) {
    const Vec3 arm = (t[0] + t[1] + t[2]) / 3 - middle, area = area_vector(t);
    for (int d = 0; d < 3; ++d)
      if (!box_.periodic[d]) volume_ += arm[d] * area[d] / closed;
  }
  if (!(std::abs(volume_) > 1e-12 * std::pow((hi_ - lo_).norm(), 3)))
    throw std::invalid_argument("the surface encloses no volume");
  if (volume_ > 0) return;
  volume_ = -volume_;
  for (Triangle &t : triangles_) std::swap(t[1], t[2]);
  for (FeatureNormals &normals : normals_) normals.turn_over();
}

void TriangulatedSolid::index()
{
  std::vector<int> numbers;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    Eigen::AlignedBox3d box;
    for (const Vec3 &corner : triangles_[t]) box.extend(corner);
    numbers.push_back(static_cast<int>(t));
    boxes.push_back(box);
  }
  tree_.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
}

/* ---------------------------------------------------------------------- */

void TriangulatedSolid::measure_centres()
{
  for (int d = 0; d < 3; ++d)
    if (box_.periodic[d]) {
      lo_[d] = box_.lo[d];
      hi_[d] = box_.lo[d] + box_.length[d];
    }
  const Vec3 length = hi_ - lo_;
  double width = std::cbrt(length.prod() / most_cells);
  const auto cells = [&](int d) { return std::max(1.0, std::floor(length[d] / width)); };
  // of a thin surface there are more, as there is one across it at least
  while (cells(0) * cells(1) * cells(2) > most_cells) width *= 1.1;
  for (int d = 0; d < 3; ++d) {
    cells_[d] = static_cast<int>(cells(d));
    cell_[d] = length[d] / cells_[d];
  }
  rounding_ = 1e-4 * cell_.norm();    // of the distances of centres
  const std::size_t count = std::size_t(cells_[0]) * cells_[1] * cells_[2];
  centre_distance_.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    Best best{HUGE_VAL};
    if (n % cells_[0] > 0) {    // the distance changes no faster than the place
      const double bound = 1.001 * (std::abs(centre_distance_.back()) + cell_[0]);
      best.square = bound * bound;
    }
    centre_distance_.push_back(static_cast<float>(exact(centre(n), best).distance));
  }
}

Vec3 TriangulatedSolid::wrapped(const Vec3 &x) const
{
  Vec3 y = x;
  for (int d = 0; d < 3; ++d)
    if (box_.periodic[d]) y[d] -= box_.length[d] * std::floor((x[d] - box_.lo[d]) / box_.length[d]);
  return y;
}

bool TriangulatedSolid::beyond(const Vec3 &x) const
{
  return (x.array() < lo_.array()).any() || (x.array() > hi_.array()).any();
}

Vec3 TriangulatedSolid::centre(std::size_t cell) const
{
  const Vec3 at(cell % cells_[0], cell / cells_[0] % cells_[1], cell / cells_[0] / cells_[1]);
  return lo_ + cell_.cwiseProduct(at + Vec3::Constant(0.5));
}

TriangulatedSolid::Estimate TriangulatedSolid::estimate(const Vec3 &x) const
{
  std::array<std::size_t, 3> at;
  Vec3 from_centre;
  for (int d = 0; d < 3; ++d) {
    at[d] = std::clamp(static_cast<int>((x[d] - lo_[d]) / cell_[d]), 0, cells_[d] - 1);
    from_centre[d] = x[d] - lo_[d] - cell_[d] * (at[d] + 0.5);
  }
  return {centre_distance_[at[0] + cells_[0] * (at[1] + cells_[1] * at[2])],
          from_centre.norm() + rounding_};
}

/* ---------------------------------------------------------------------- */

void TriangulatedSolid::try_triangle(int t, const Vec3 &x, Best &best) const
{
  const auto w = closest_on_triangle(x, triangles_[t]);
  const Triangle &p = triangles_[t];
  const Vec3 arm = x - (w[0] * p[0] + w[1] * p[1] + w[2] * p[2]);
  const double square = arm.squaredNorm();
  if (square < best.square) best = {square, t, w, arm};
}

void TriangulatedSolid::descend(int node, const Vec3 &x, Best &best) const
{
  const int *first = nullptr, *last = nullptr, *object = nullptr, *objects_end = nullptr;
  tree_.getChildren(node, first, last, object, objects_end);
  for (; object != objects_end; ++object) try_triangle(*object, x, best);
  const auto square = [&](int child) { return tree_.getVolume(child).squaredExteriorDistance(x); };
  if (last == first) return;
  int near = *first, far = last[-1];
  double to_near = square(near), to_far = near == far ? HUGE_VAL : square(far);
  if (to_far < to_near) {
    std::swap(near, far);
    std::swap(to_near, to_far);
  }
  if (to_near < best.square) descend(near, x, best);
  if (to_far < best.square) descend(far, x, best);
}

/// Among all images of the surface.
void TriangulatedSolid::search(const Vec3 &x, Best &best) const
{
  const int root = tree_.getRootIndex();
  const Eigen::AlignedBox3d &all = tree_.getVolume(root);
  descend(root, x, best);
  for (int k = -box_.periodic[2]; k <= box_.periodic[2]; ++k)
    for (int j = -box_.periodic[1]; j <= box_.periodic[1]; ++j)
      for (int i = -box_.periodic[0]; i <= box_.periodic[0]; ++i) {
        if (i == 0 && j == 0 && k == 0) continue;
        Vec3 image = x;
        if (i) image[0] += i * box_.length[0];
        if (j) image[1] += j * box_.length[1];
        if (k) image[2] += k * box_.length[2];
        if (all.squaredExteriorDistance(image) < best.square) descend(root, image, best);
      }
}

TriangulatedSolid::Nearest TriangulatedSolid::exact(const Vec3 &x, Best best) const
{
  search(x, best);
  if (best.triangle < 0) return {Vec3::Zero(), HUGE_VAL};
  const Vec3 &normal = normals_[best.triangle].at(best.weights);
  const double distance = std::sqrt(best.square);
  return {best.from_surface, best.from_surface.dot(normal) > 0 ? distance : -distance};
}

bool TriangulatedSolid::contains(const Vec3 &x) const
{
  const Vec3 y = wrapped(x);
  if (beyond(y)) return false;
  const Estimate guess = estimate(y);
  if (std::abs(guess.distance) > guess.error) return guess.distance < 0;
  last_ = y;
  nearest_to_last_ = exact(y, {guess.largest() * guess.largest()});
  return nearest_to_last_.distance <= 0;
}

std::optional<TriangulatedSolid::Nearest> TriangulatedSolid::nearest(const Vec3 &x,
                                                                     double cutoff) const
{
  const Vec3 y = wrapped(x);
  double bound = cutoff;
  if (!beyond(y)) {
    const Estimate guess = estimate(y);
    if (std::abs(guess.distance) - guess.error > cutoff) return {};
    bound = std::min(bound, guess.largest());
  }
  const Nearest found = y == last_ ? nearest_to_last_ : exact(y, {bound * bound});
  if (!(std::abs(found.distance) < cutoff)) return {};
  return found;
}

}    // namespace rbc
