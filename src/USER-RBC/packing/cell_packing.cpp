#include "packing/cell_packing.h"

#include "geometry/point_bins.h"
#include "packing/fire.h"
#include "packing/surface_gap.h"

#include <algorithm>
#include <cmath>

namespace rbc {

namespace {

// Lengths are in those of the templates: they shrink with the cells. Those below are in radii of
// the largest cell.
constexpr double field_reach = 0.1;         // beyond the gap
constexpr double growing_overlap = 0.04;    // above which cells do not grow
constexpr double largest_move = 0.02;
constexpr double largest_margin = 0.05;

constexpr double depth_share = 0.15;    // of half the thickness that growing cells may overlap
constexpr double margin_share = 0.2;    // of the spacing of the fields
constexpr double growth = 0.15, fastest_growth = 0.02, shrinking = 0.99;
constexpr int shrinking_steps = 100;
constexpr double time_step = 0.15;    // of unit masses on springs of unit stiffness at each vertex

constexpr double first_fraction = 0.05;    // of the part that spheres about the cells fill at first
constexpr double largest_first_size = 0.35, least_first_size = 0.01, first_size_falls = 0.7;
constexpr int draws = 1000000, most_collisions = 1000;    // of a cell

}    // namespace

CellPacking::CellPacking(const PackingBox &box,
                         const std::vector<const SurfaceTemplate *> &templates,
                         std::vector<int> kinds, double gap, unsigned seed, Ranks ranks) :
    box_(box),
    kinds_(std::move(kinds)), gap_(gap), ranks_(std::move(ranks)), random_(seed), part_lo_(box.lo),
    part_length_(box.length)
{
  for (const SurfaceTemplate *surface : templates)
    for (const Vec3 &vertex : surface->vertices) radius_ = std::max(radius_, vertex.norm());
  for (const SurfaceTemplate *surface : templates)
    shapes_.push_back(std::make_unique<RigidShape>(*surface, gap + field_reach * radius_));
  growing_overlap_ = growing_overlap * radius_;
  for (const auto &shape : shapes_) {
    margin_ = std::max(margin_, margin_share * shape->field.spacing());
    growing_overlap_ = std::min(growing_overlap_, depth_share * shape->field.depth());
  }
}

void CellPacking::confine(const Enclosure &enclosure, const Vec3 &lo, const Vec3 &length)
{
  enclosure_ = &enclosure;
  part_lo_ = lo;
  part_length_ = length;
}

void CellPacking::avoid(std::vector<Vec3> points)
{
  points_ = std::move(points);
}

double CellPacking::reach() const
{
  return gap_ + field_reach * radius_;
}

double CellPacking::uniform(double lo, double hi)
{
  return lo + (hi - lo) * std::ldexp(static_cast<double>(random_() >> 11), -53);
}

std::pair<int, int> CellPacking::share(std::size_t count) const
{
  return {static_cast<int>(count * ranks_.me / ranks_.count),
          static_cast<int>(count * (ranks_.me + 1) / ranks_.count)};
}

bool CellPacking::in_part(const Vec3 &x) const
{
  return !enclosure_ || enclosure_->contains(x);
}

/* ----------------------------------------------------------------------
   small spheres about the cells do not overlap, directions are uniform over all rotations
   (Shoemake, Graphics Gems III, 1992)
------------------------------------------------------------------------- */

bool CellPacking::place()
{
  const double spheres = kinds_.size() * 4 * M_PI / 3 * radius_ * radius_ * radius_;
  size_ = std::min(largest_first_size, std::cbrt(first_fraction * part_length_.prod() / spheres));
  for (; size_ > least_first_size; size_ *= first_size_falls)
    if (place_spheres()) return true;
  size_ = 0;
  return false;
}

bool CellPacking::place_spheres()
{
  const double apart = 2 * size_ * radius_;
  PointBins placed(box_, apart);
  for (const Vec3 &point : points_) placed.add(point);
  cells_.clear();
  rotations_.clear();
  anchors_.clear();
  for (const int kind : kinds_) {
    Vec3 centre;
    bool fits = false;
    int collisions = 0;
    for (int draw = 0; draw < draws && collisions < most_collisions && !fits; ++draw) {
      for (int d = 0; d < 3; ++d) centre[d] = part_lo_[d] + uniform(0, 1) * part_length_[d];
      if (!in_part(centre)) continue;
      fits = true;
      placed.visit(centre, apart, [&](int, const Vec3 &) { fits = false; });
      collisions += !fits;
    }
    if (!fits) return false;
    placed.add(centre);
    anchors_.push_back(centre);
    const double u = uniform(0, 1), a = uniform(0, 2 * M_PI), b = uniform(0, 2 * M_PI);
    rotations_.emplace_back(std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a),
                            std::sqrt(1 - u) * std::cos(a), std::sqrt(u) * std::sin(b));
    cells_.push_back({shapes_[kind].get(), centre, rotations_.back().toRotationMatrix(), size_});
  }
  return true;
}

RigidCell CellPacking::shifted(const Pair &pair) const
{
  RigidCell cell = cells_[pair.b];
  cell.centre += pair.image;
  return cell;
}

void CellPacking::find_neighbors()
{
  const double widest = size_ * (2 * radius_ + reach());
  PointBins centres(box_, widest), points(box_, widest);
  for (const RigidCell &cell : cells_) centres.add(cell.centre);
  for (const Vec3 &point : points_) points.add(point);

  pairs_.clear();
  for (int a = 0; a < static_cast<int>(cells_.size()); ++a) {
    const RigidCell &cell = cells_[a];
    centres.visit(cell.centre, widest, [&](int b, const Vec3 &image) {
      const double near = size_ * (cell.shape->radius + cells_[b].shape->radius + reach());
      if (b > a && (image - cell.centre).norm() < near)
        pairs_.push_back({a, b, image - cells_[b].centre});
    });
  }

  contacts_.clear();
  const auto [first, last] = share(pairs_.size());
  for (int p = first; p < last; ++p) {
    const RigidCell &a = cells_[pairs_[p].a], b = shifted(pairs_[p]);
    Contact contact{p, {a, b, reach()}, {b, a, reach()}};
    if (!contact.a_to_b.empty() || !contact.b_to_a.empty()) contacts_.push_back(std::move(contact));
  }

  singles_.clear();
  const auto [first_cell, last_cell] = share(cells_.size());
  for (int c = first_cell; c < last_cell; ++c) {
    singles_.push_back({c, {}});
    const double near = size_ * (cells_[c].shape->radius + reach());
    points.visit(cells_[c].centre, near,
                 [&](int, const Vec3 &image) { singles_.back().points.push_back(image); });
  }
  moved_.assign(cells_.size(), 0);
  grown_ = 0;
}

bool CellPacking::neighbors_are_old() const
{
  const double farthest = *std::max_element(moved_.begin(), moved_.end());
  return 2 * farthest + (2 * radius_ + reach()) * grown_ > reach() - clearance();
}

/* ----------------------------------------------------------------------
   of walls, the enclosure and points
------------------------------------------------------------------------- */

void CellPacking::push_from_walls(const Vec3 &arm, const Vec3 &x, Wrench &push) const
{
  const double distance = gap_ / 2 + margin_;
  for (int d = 0; d < 3; ++d) {
    if (box_.periodic[d]) continue;
    const double low = distance - (x[d] - box_.lo[d]) / size_,
                 high = distance - (box_.lo[d] + box_.length[d] - x[d]) / size_;
    if (low > 0) push.add(arm, low * Vec3::Unit(d), low);
    if (high > 0) push.add(arm, -high * Vec3::Unit(d), high);
  }
}

Wrench CellPacking::outer_push(const Single &single) const
{
  const RigidCell &cell = cells_[single.cell];
  const bool near_wall = box_.clearance(cell.centre) < size_ * (cell.shape->radius + clearance());
  Wrench push;
  for (int v = 0; (near_wall || enclosure_) && v < cell.shape->surface.vertex_count(); ++v) {
    const Vec3 arm = cell.rotation * cell.shape->surface.vertices[v];
    const Vec3 x = cell.centre + size_ * arm;
    if (near_wall) push_from_walls(arm, x, push);
    if (!enclosure_) continue;
    const Vec3 beyond = x + size_ * margin_ * arm.normalized();
    const auto [depth, inward] = enclosure_->excess(anchors_[single.cell], beyond);
    if (depth > 0) push.add(arm, depth / size_ * inward, depth / size_);
  }
  for (const Vec3 &point : single.points) {
    const auto [distance, gradient] = cell.shape->field.at(cell.body(point));
    const double depth = clearance() - distance;
    if (depth > 0)
      push.add((point - cell.centre) / size_, -depth * (cell.rotation * gradient), depth);
  }
  return push;
}

/* ----------------------------------------------------------------------
   on all cells, in lengths of the templates; each rank finds its share
------------------------------------------------------------------------- */

std::vector<Wrench> CellPacking::pushes()
{
  constexpr int size = 8;
  std::vector<double> mine;
  const auto pack = [&](int number, const Wrench &push) {
    if (push.overlap > 0)
      mine.insert(mine.end(), {double(number), push.force[0], push.force[1], push.force[2],
                               push.torque[0], push.torque[1], push.torque[2], push.overlap});
  };
  for (const Contact &contact : contacts_) {
    const Pair &pair = pairs_[contact.pair];
    const RigidCell &a = cells_[pair.a], b = shifted(pair);
    Wrench on_a, on_b;
    contact.a_to_b.push(a, b, clearance(), on_a);
    contact.b_to_a.push(b, a, clearance(), on_b);
    on_a.force -= on_b.force;
    on_a.torque -= on_b.torque + ((b.centre - a.centre) / size_).cross(on_b.force);
    on_a.overlap = std::max(on_a.overlap, on_b.overlap);
    pack(contact.pair, on_a);
  }
  const int pairs = static_cast<int>(pairs_.size());
  for (const Single &single : singles_) pack(pairs + single.cell, outer_push(single));

  const std::vector<double> all = ranks_.gather(mine);
  std::vector<Wrench> pushes(cells_.size());
  const auto act = [&](Wrench &on, const Vec3 &force, const Vec3 &torque, double overlap) {
    on.force += force;
    on.torque += torque;
    on.overlap = std::max(on.overlap, overlap);
  };
  for (const bool outer : {false, true})
    for (std::size_t at = 0; at < all.size(); at += size) {
      const int number = static_cast<int>(all[at]);
      if ((number >= pairs) != outer) continue;
      const Vec3 force(&all[at + 1]), torque(&all[at + 4]);
      const double overlap = all[at + 7];
      if (outer)
        act(pushes[number - pairs], force, torque, overlap);
      else {
        const Pair &pair = pairs_[number];
        const Vec3 arm = (cells_[pair.a].centre - cells_[pair.b].centre - pair.image) / size_;
        act(pushes[pair.a], force, torque, overlap);
        act(pushes[pair.b], -force, -(torque + arm.cross(force)), overlap);
      }
    }
  return pushes;
}

/* ----------------------------------------------------------------------
   six numbers a cell: shift in lengths of the template, rotation in those at the radius of gyration
------------------------------------------------------------------------- */

void CellPacking::move(const std::vector<double> &moves)
{
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    RigidCell &cell = cells_[c];
    const Vec3 shift(&moves[6 * c]), rotation = Vec3(&moves[6 * c + 3]) / cell.shape->gyration;
    const double angle = rotation.norm();
    cell.centre += size_ * shift;
    if (angle > 0)
      rotations_[c] =
          (Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)) * rotations_[c])
              .normalized();
    cell.rotation = rotations_[c].toRotationMatrix();
    moved_[c] += shift.norm() + cell.shape->radius * angle;
    if (in_part(cell.centre)) anchors_[c] = cell.centre;
  }
}

void CellPacking::resize(double size)
{
  grown_ += std::abs(size / size_ - 1);
  size_ = size;
  for (RigidCell &cell : cells_) cell.size = size;
}

/* ----------------------------------------------------------------------
   until no overlap is left but a part of the margin. Growing cells reach full size where there is
   room.
------------------------------------------------------------------------- */

bool CellPacking::settle(int steps, bool growing)
{
  Fire fire(6 * cells_.size(), time_step / 3, time_step, largest_move * radius_);
  std::vector<double> forces(6 * cells_.size());
  for (const int last = steps_taken_ + steps; steps_taken_ < last; ++steps_taken_) {
    if (neighbors_are_old()) find_neighbors();
    const std::vector<Wrench> on = pushes();
    double overlap = 0;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      overlap = std::max(overlap, on[c].overlap);
      for (int d = 0; d < 3; ++d) {
        forces[6 * c + d] = on[c].force[d];
        forces[6 * c + 3 + d] = on[c].torque[d] / cells_[c].shape->gyration;
      }
    }
    if ((size_ == 1 || !growing) && overlap < margin_ / 2) return true;
    if (overlap > 0) move(fire.move(forces));
    const double room = growing_overlap_ - overlap;
    if (growing && room > 0)
      resize(std::min(1.0, size_ * (1 + std::min(fastest_growth, growth * room / radius_))));
  }
  return false;
}

/* ----------------------------------------------------------------------
   checks the distances of the surfaces themselves. The margin widens where the distance fields were
   not exact enough.
------------------------------------------------------------------------- */

bool CellPacking::check()
{
  find_neighbors();
  const double gap = size_ * gap_, far = gap + size_ * margin_;
  double least = far, least_wall = HUGE_VAL;
  bool inside = true;
  for (const Contact &contact : contacts_) {
    const Pair &pair = pairs_[contact.pair];
    least = std::min(least, surface_gap(cells_[pair.a], shifted(pair), far));
  }
  for (const Single &single : singles_) {
    const RigidCell &cell = cells_[single.cell];
    for (const Vec3 &point : single.points) least = std::min(least, surface_gap(point, cell, far));
    for (int v = 0; v < cell.shape->surface.vertex_count(); ++v) {
      const Vec3 x = cell.vertex(v);
      inside = inside && in_part(x);
      least_wall = std::min(least_wall, box_.clearance(x));
    }
  }
  const std::vector<double> all = ranks_.gather({least, least_wall, double(inside)});
  for (std::size_t at = 0; at < all.size(); at += 3) {
    least = std::min(least, all[at]);
    least_wall = std::min(least_wall, all[at + 1]);
    inside = inside && all[at + 2] > 0;
  }
  least_gap_ = least;
  if (least >= gap && least_wall >= gap / 2 && inside) return true;
  margin_ += std::max({gap - least, gap / 2 - least_wall, size_ * margin_ / 10}) / size_;
  return false;
}

bool CellPacking::pack(int steps)
{
  steps_taken_ = 0;
  if (!place()) return false;
  find_neighbors();
  const double first_size = size_, margin = margin_;
  while (settle(steps - steps_taken_, true) && margin_ < largest_margin * radius_)
    if (check()) return true;
  while (size_ > first_size / 2) {
    margin_ = margin;
    resize(shrinking * size_);
    while (settle(shrinking_steps, false) && margin_ < largest_margin * radius_)
      if (check()) return false;
  }
  size_ = 0;
  return false;
}

}    // namespace rbc
