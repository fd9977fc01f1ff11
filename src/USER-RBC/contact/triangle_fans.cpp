#include "contact/triangle_fans.h"

#include "geometry/tight_vector.h"

#include <algorithm>
#include <utility>

namespace rbc {

void TriangleFans::find(const std::vector<NearTriangles::Triangle> &all, int points)
{
  const int count = static_cast<int>(all.size());
  around_.fill(points, next_, [&](const auto &put) {
    for (int t = 0; t < count; ++t)
      for (int v : all[t].corner) put(v, t);
  });
  choose_middles(all);
  fan_of_.resize(all.size());
  int fans = 0;
  for (int t = 0; t < count; ++t) {
    fan_of_[t] = fan_of(all, all[t]);
    fans = std::max(fans, fan_of_[t] + 1);
  }
  collect(all, fans);
  collect_corners(all, next_);
}

std::vector<TriangleFans::Place>
TriangleFans::places(const std::vector<NearTriangles::Triangle> &all) const
{
  std::vector<Place> places(all.size(), Place{0, 0, 0, 0});
  for (std::size_t t = 0; t < all.size(); ++t) {
    Place &place = places[t];
    place.fan = static_cast<unsigned>(fan_of_[t]);
    for (unsigned c = 0; c < 3; ++c) {
      const int v = all[t].corner[c];
      if (nearest_[v] != fan_of_[t]) continue;
      if (in_middle_[v]) {
        place.by_middle = 1;
        place.known = c;
      } else {
        if (!place.by_middle && place.rim == 0) place.known = c;
        place.rim |= 1u << c;
      }
    }
  }
  return places;
}

/* ----------------------------------------------------------------------
   A triangle whose corner at a rim has no fan here, as its middle is not, becomes one.
------------------------------------------------------------------------- */

void TriangleFans::join(const std::vector<NearTriangles::Triangle> &all,
                        const std::vector<Place> &places, int points)
{
  nearest_.assign(points, -1);
  resize_tightly(fan_of_, all.size());
  int fans = 0;
  for (std::size_t t = 0; t < all.size(); ++t) {
    if (!places[t].by_middle) continue;
    int &fan = nearest_[all[t].corner[places[t].known]];
    if (fan < 0) fan = fans++;
    fan_of_[t] = fan;
    for (int c = 0; c < 3; ++c)
      if (places[t].rim & 1u << c) nearest_[all[t].corner[c]] = fan;
  }
  for (std::size_t t = 0; t < all.size(); ++t) {
    if (places[t].by_middle) continue;
    const int fan = nearest_[all[t].corner[places[t].known]];
    fan_of_[t] = fan >= 0 ? fan : fans++;
  }
  collect(all, fans);
  collect_corners(all, nearest_);    // which no one needs any more
}

void TriangleFans::collect(const std::vector<NearTriangles::Triangle> &all, int fans)
{
  triangles.fill(fans, next_, [&](const auto &put) {
    for (std::size_t t = 0; t < all.size(); ++t) put(fan_of_[t], static_cast<int>(t));
  });
}

/* ----------------------------------------------------------------------
   A corner that is not beside the middle of a fan becomes one. The fans are numbered so.
------------------------------------------------------------------------- */

void TriangleFans::choose_middles(const std::vector<NearTriangles::Triangle> &all)
{
  nearest_.assign(around_.count(), -1);
  in_middle_.assign(around_.count(), 0);
  int fans = 0;
  for (const NearTriangles::Triangle &triangle : all)
    for (int v : triangle.corner) {
      if (nearest_[v] >= 0) continue;
      in_middle_[v] = 1;
      for (int n = around_.begin[v]; n < around_.begin[v + 1]; ++n)
        for (int w : all[around_.number[n]].corner)
          if (nearest_[w] < 0) nearest_[w] = fans;
      ++fans;
    }
}

/* ----------------------------------------------------------------------
   that of its corner in a middle, else of a neighbor with such a corner, if one of its own corners
   at the rim of that fan has no other
------------------------------------------------------------------------- */

int TriangleFans::fan_of(const std::vector<NearTriangles::Triangle> &all,
                         const NearTriangles::Triangle &triangle) const
{
  const auto middle_of = [this](const NearTriangles::Triangle &t) {
    for (int v : t.corner)
      if (in_middle_[v]) return nearest_[v];
    return -1;
  };
  const int own = middle_of(triangle);
  if (own >= 0) return own;
  const auto is_corner = [&](int w) {
    return w == triangle.corner[0] || w == triangle.corner[1] || w == triangle.corner[2];
  };
  const auto is_nearest = [&](int fan) {
    return fan == nearest_[triangle.corner[0]] || fan == nearest_[triangle.corner[1]] ||
           fan == nearest_[triangle.corner[2]];
  };
  for (int v : triangle.corner)
    for (int n = around_.begin[v]; n < around_.begin[v + 1]; ++n) {
      const NearTriangles::Triangle &other = all[around_.number[n]];
      const int fan = middle_of(other);
      if (fan >= 0 && is_nearest(fan) &&
          std::count_if(other.corner.begin(), other.corner.end(), is_corner) == 2)
        return fan;
    }
  return nearest_[triangle.corner[0]];
}

/* ----------------------------------------------------------------------
   last_fan: work space, of each corner the last fan that has it
------------------------------------------------------------------------- */

void TriangleFans::collect_corners(const std::vector<NearTriangles::Triangle> &all,
                                   std::vector<int> &last_fan)
{
  last_fan.assign(nearest_.size(), -1);
  corners.number.clear();
  corners.begin.assign(1, 0);
  for (int fan = 0; fan < triangles.count(); ++fan) {
    for (int n = triangles.begin[fan]; n < triangles.begin[fan + 1]; ++n)
      for (int v : all[triangles.number[n]].corner)
        if (std::exchange(last_fan[v], fan) != fan) push_back_tightly(corners.number, v);
    while (corners.number.size() % GROUP) {
      const int again = corners.number[corners.begin.back()];
      push_back_tightly(corners.number, again);
    }
    corners.begin.push_back(static_cast<int>(corners.number.size()));
  }
}

std::size_t TriangleFans::bytes() const
{
  return triangles.bytes() + corners.bytes() + around_.bytes() + in_middle_.capacity() +
         (nearest_.capacity() + fan_of_.capacity() + next_.capacity()) * sizeof(int);
}

}    // namespace rbc
