#include "triangulated_solid.h"

#include "point_bins.h"

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace rbc {

namespace {

constexpr double weld_share = 1e-6;    // of the diagonal: corners nearer to each other are one
constexpr double face_share = 1e-5;    // of the box: edges nearer to a face lie on it
constexpr double most_cells = 150000;

std::string text(const Vec3 &x)
{
  const auto number = [](double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.6g", value);
    return std::string(digits);
  };
  return "(" + number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + ")";
}

void require(bool condition, const std::string &problem)
{
  if (!condition) throw std::invalid_argument(problem);
}

Vec3 area_vector(const Triangle &t)
{
  return (t[1] - t[0]).cross(t[2] - t[0]) / 2;
}

}    // namespace

TriangulatedSolid::TriangulatedSolid(std::vector<Triangle> triangles, const PackingBox &box) :
    box_(box), triangles_(std::move(triangles))
{
  require(!triangles_.empty(), "there are no triangles");
  lo_ = hi_ = triangles_[0][0];
  for (const Triangle &triangle : triangles_)
    for (const Vec3 &corner : triangle) {
      lo_ = lo_.cwiseMin(corner);
      hi_ = hi_.cwiseMax(corner);
    }
  join(weld());
  orient();
  index();
  measure_centres();
}

/* ----------------------------------------------------------------------
   numbers of the corners; triangles without area go
------------------------------------------------------------------------- */

std::vector<TriangulatedSolid::Corners> TriangulatedSolid::weld()
{
  const double tolerance = weld_share * (hi_ - lo_).norm();
  double edge = 0;
  for (const Triangle &t : triangles_)
    edge += ((t[1] - t[0]).norm() + (t[2] - t[1]).norm()) / (2.0 * triangles_.size());
  const PackingBox around{lo_, (hi_ - lo_).array() + 2 * tolerance, {false, false, false}};
  PointBins bins(around, std::max(edge, 4 * tolerance));
  std::vector<Vec3> vertices;
  std::vector<Corners> corners;
  std::vector<Triangle> kept;
  for (Triangle triangle : triangles_) {
    Corners numbers;
    for (int c = 0; c < 3; ++c) {
      int number = -1;
      bins.visit(triangle[c], tolerance, [&](int n, const Vec3 &) { number = n; });
      if (number < 0) {
        number = static_cast<int>(vertices.size());
        vertices.push_back(triangle[c]);
        bins.add(triangle[c]);
      }
      numbers[c] = number;
      triangle[c] = vertices[number];
    }
    if (numbers[0] == numbers[1] || numbers[1] == numbers[2] || numbers[2] == numbers[0]) continue;
    corners.push_back(numbers);
    kept.push_back(triangle);
  }
  triangles_ = std::move(kept);
  require(!triangles_.empty(), "no triangle has an area");
  return corners;
}

/* ----------------------------------------------------------------------
   finds the neighbours of all edges, through periodic faces too, and from them the normals
------------------------------------------------------------------------- */

void TriangulatedSolid::join(const std::vector<Corners> &corners)
{
  const int count = static_cast<int>(triangles_.size());
  int vertices = 0;
  for (const Corners &c : corners) vertices = std::max({vertices, c[0] + 1, c[1] + 1, c[2] + 1});
  std::vector<Vec3> place(vertices);
  std::map<std::pair<int, int>, std::pair<int, int>> left;    // of directed edges: triangle, edge
  for (int t = 0; t < count; ++t)
    for (int e = 0; e < 3; ++e) {
      const int a = corners[t][e], b = corners[t][(e + 1) % 3];
      place[a] = triangles_[t][e];
      if (left.emplace(std::make_pair(a, b), std::make_pair(t, e)).second) continue;
      require(left.count({b, a}) == 0, "more than two triangles share the edge from " +
                                           text(triangles_[t][e]) + " to " +
                                           text(triangles_[t][(e + 1) % 3]));
      require(false, "the triangles on both sides of the edge from " + text(triangles_[t][e]) +
                         " to " + text(triangles_[t][(e + 1) % 3]) + " are not oriented alike");
    }

  // edges of one triangle must lie on periodic faces
  std::array<bool, 3> open{};
  std::vector<int> twin(vertices);    // the vertex of which one is the periodic image
  for (int v = 0; v < vertices; ++v) twin[v] = v;
  struct OpenEdge {
    int a, b, triangle, edge;
  };
  std::vector<OpenEdge> lower, upper;
  std::vector<std::array<bool, 3>> at_lower(vertices), at_upper(vertices);
  const auto on_face = [&](int a, int b, int d, bool high) {
    const double face = box_.lo[d] + (high ? box_.length[d] : 0);
    const double tolerance = face_share * box_.length[d];
    return std::abs(place[a][d] - face) < tolerance && std::abs(place[b][d] - face) < tolerance;
  };
  for (const auto &[edge, owner] : left) {
    const auto [a, b] = edge;
    if (left.count({b, a})) continue;
    bool found = false;
    for (int d = 0; d < 3 && !found; ++d)
      for (const bool high : {false, true}) {
        if (!box_.periodic[d] || !on_face(a, b, d, high)) continue;
        open[d] = found = true;
        for (int v : {a, b}) (high ? at_upper : at_lower)[v][d] = true;
        (high ? upper : lower).push_back({a, b, owner.first, owner.second});
        break;
      }
    require(found, "the surface is not closed: the edge from " + text(place[a]) + " to " +
                       text(place[b]) +
                       " belongs to one triangle only, and lies on no periodic face of the box");
  }
  box_.periodic = open;

  const double tolerance = face_share * (box_.length.allFinite() ? box_.length.norm() : 1);
  PointBins bins(box_.length.allFinite() ? box_ : PackingBox{lo_, hi_ - lo_, {false, false, false}},
                 std::max(4 * tolerance, (hi_ - lo_).maxCoeff() / 100));
  std::vector<int> number;
  for (int v = 0; v < vertices; ++v) {
    const bool low = at_lower[v][0] || at_lower[v][1] || at_lower[v][2],
               high = at_upper[v][0] || at_upper[v][1] || at_upper[v][2];
    if (!low && !high) continue;
    for (int d = 0; d < 3; ++d) {
      if (at_lower[v][d]) place[v][d] = box_.lo[d];
      if (at_upper[v][d]) place[v][d] = box_.lo[d] + box_.length[d];
    }
    bool known = false;
    bins.visit(place[v], tolerance, [&](int n, const Vec3 &) {
      twin[v] = number[n];
      known = true;
    });
    if (known) continue;
    bins.add(place[v]);
    number.push_back(v);
  }
  for (int t = 0; t < count; ++t)    // onto the faces exactly
    for (int c = 0; c < 3; ++c) triangles_[t][c] = place[corners[t][c]];

  std::map<std::pair<int, int>, std::pair<int, int>> through;    // open edges by their twins
  for (const OpenEdge &e : lower) through[{twin[e.a], twin[e.b]}] = {e.triangle, e.edge};
  std::vector<Vec3> corner_normals(vertices, Vec3::Zero());
  normals_.resize(count);
  for (int t = 0; t < count; ++t) normals_[t].face = area_vector(triangles_[t]).normalized();
  for (int t = 0; t < count; ++t)
    for (int c = 0; c < 3; ++c) {
      const Triangle &p = triangles_[t];
      const Vec3 u = p[(c + 1) % 3] - p[c], v = p[(c + 2) % 3] - p[c];
      corner_normals[twin[corners[t][c]]] +=
          std::atan2(u.cross(v).norm(), u.dot(v)) * normals_[t].face;
      const int a = corners[t][c], b = corners[t][(c + 1) % 3];
      const auto other = left.find({b, a});
      Vec3 &edge = normals_[t].edge[(c + 2) % 3];
      edge = normals_[t].face;
      if (other != left.end()) edge += normals_[other->second.first].face;
    }
  for (const OpenEdge &e : upper) {
    const auto found = through.find({twin[e.b], twin[e.a]});
    if (found == through.end()) continue;
    const auto [t, edge] = found->second;
    const Vec3 sum = normals_[t].face + normals_[e.triangle].face;
    normals_[t].edge[(edge + 2) % 3] = normals_[e.triangle].edge[(e.edge + 2) % 3] = sum;
  }
  require(lower.empty() == upper.empty(), "the surface leaves the box through a periodic face and "
                                          "does not come back through the opposite one");
  for (int t = 0; t < count; ++t)
    for (int c = 0; c < 3; ++c) normals_[t].corner[c] = corner_normals[twin[corners[t][c]]];
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
  require(std::abs(volume_) > 1e-12 * std::pow((hi_ - lo_).norm(), 3), "it encloses no volume");
  if (volume_ > 0) return;
  volume_ = -volume_;
  for (Triangle &t : triangles_) std::swap(t[1], t[2]);
  for (Normals &n : normals_) {
    n.face = -n.face;
    std::swap(n.edge[1], n.edge[2]);
    std::swap(n.corner[1], n.corner[2]);
    for (int c = 0; c < 3; ++c) {
      n.edge[c] = -n.edge[c];
      n.corner[c] = -n.corner[c];
    }
  }
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
  const double width = std::cbrt(length.prod() / most_cells);
  for (int d = 0; d < 3; ++d) {
    cells_[d] = std::max(1, static_cast<int>(length[d] / width));
    cell_[d] = length[d] / cells_[d];
  }
  half_diagonal_ = 0.5001 * cell_.norm();    // distances of cells are rounded
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

std::size_t TriangulatedSolid::cell_of(const Vec3 &x) const
{
  std::array<std::size_t, 3> at;
  for (int d = 0; d < 3; ++d)
    at[d] = std::clamp(static_cast<int>((x[d] - lo_[d]) / cell_[d]), 0, cells_[d] - 1);
  return at[0] + cells_[0] * (at[1] + cells_[1] * at[2]);
}

Vec3 TriangulatedSolid::centre(std::size_t cell) const
{
  const Vec3 at(cell % cells_[0], cell / cells_[0] % cells_[1], cell / cells_[0] / cells_[1]);
  return lo_ + cell_.cwiseProduct(at + Vec3::Constant(0.5));
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
  const auto square = [&](const int *child) {
    return tree_.getVolume(*child).squaredExteriorDistance(x);
  };
  if (last - first == 2 && square(first + 1) < square(first)) {
    if (square(first + 1) < best.square) descend(first[1], x, best);
    last = first + 1;
  }
  for (; first != last; ++first)
    if (square(first) < best.square) descend(*first, x, best);
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
  const Normals &normals = normals_[best.triangle];
  const auto &w = best.weights;
  const auto zeros = std::count(w.begin(), w.end(), 0.0);
  const Vec3 &normal = zeros == 0 ? normals.face
                       : zeros == 1
                           ? normals.edge[std::find(w.begin(), w.end(), 0.0) - w.begin()]
                           : normals.corner[std::max_element(w.begin(), w.end()) - w.begin()];
  const double distance = std::sqrt(best.square);
  return {best.from_surface, best.from_surface.dot(normal) > 0 ? distance : -distance};
}

bool TriangulatedSolid::holds(const Vec3 &x) const
{
  const Vec3 y = wrapped(x);
  if (beyond(y)) return false;
  const std::size_t cell = cell_of(y);
  const double distance = centre_distance_[cell];
  if (std::abs(distance) > half_diagonal_) return distance < 0;
  const double bound = 1.001 * (std::abs(distance) + half_diagonal_);
  last_ = y;
  nearest_to_last_ = exact(y, {bound * bound});
  return nearest_to_last_.distance <= 0;
}

std::optional<TriangulatedSolid::Nearest> TriangulatedSolid::nearest(const Vec3 &x,
                                                                     double cutoff) const
{
  const Vec3 y = wrapped(x);
  double bound = cutoff;
  if (!beyond(y)) {
    const double distance = std::abs(centre_distance_[cell_of(y)]);
    if (distance - half_diagonal_ > cutoff) return {};
    bound = std::min(bound, 1.001 * (distance + half_diagonal_));
  }
  const Nearest found = y == last_ ? nearest_to_last_ : exact(y, {bound * bound});
  if (!(std::abs(found.distance) < cutoff)) return {};
  return found;
}

}    // namespace rbc
