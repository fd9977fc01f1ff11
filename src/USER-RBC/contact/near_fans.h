#pragma once

#include "contact/held_bodies.h"
#include "contact/near_triangles.h"
#include "contact/triangle_fans.h"
#include "geometry/spatial_bins.h"
#include "geometry/vector_loop.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace rbc {

/// Finds pairs of fans that are near each other by the spheres around them.
class NearFans {
 public:
  using Surface = NearTriangles::Surface;

  /// A pair is found if one of its fans has one of the `owned` first points. Two fans of one
  /// surface are a pair only with `own_surfaces`. Without the `places` of triangles in fans these
  /// are found anew.
  void build(const std::vector<NearTriangles::Triangle> &triangles,
             const std::vector<TriangleFans::Place> *places, int points, int owned,
             bool own_surfaces);

  const TriangleFans &fans() const { return fans_; }

  bool is_owned(int fan) const { return owned_[fan] != 0; }
  Surface surface(int fan) const { return surface_[fan]; }

  /// Holds the corners of all fans at these positions, for pairs nearer than `reach`.
  void hold(const double *x, double reach);

  /// These corners.
  const HeldBodies &held() const { return held_; }

  /// The fans that can be one of a pair.
  const std::vector<int> &near_owned() const { return near_owned_; }

  /// Calls f(first, second) once for each pair whose spheres are nearer than the reach.
  template <typename Function> void visit_pairs(const Function &f)
  {
    const double largest = held_.largest_radius();
    const SpatialBins bins(held_.centres().data(), held_.count(), reach_ + 2 * largest);
    sort(bins);
    for (int sphere = 0; sphere < static_cast<int>(near_owned_.size()); ++sphere) {
      const PlainVector centre = held_.centre(spheres_.fan[sphere]);
      bool own_row = true;
      bins.visit_half_within(
          centre, reach_ + spheres_.radius[sphere] + largest, [&](int first, int last) {
            const int begin = std::exchange(own_row, false) ? sphere + 1 : bin_begin_[first];
            visit_row(sphere, begin, bin_begin_[last + 1], f);
          });
    }
  }

  std::size_t bytes() const;

 private:
  static constexpr int AT_ONCE = 8;    ///< loops run on into what is no sphere any more

  /// Of fans near owned ones, in the order of their bins, with centres from an origin. Single
  /// precision does, as spheres are made larger by what it may be off.
  struct Spheres {
    PlainVector origin;
    std::vector<float> x, y, z, radius;
    std::vector<std::int32_t> surface, owned;    ///< owned: 1 if a corner is
    std::vector<int> fan;

    void resize(std::size_t size);
  };

  TriangleFans fans_;
  bool own_surfaces_ = false;
  std::vector<char> owned_;    ///< of each fan, whether a corner is
  std::vector<Surface> surface_;
  HeldBodies held_;
  double reach_ = 0;
  std::vector<int> near_owned_, bin_of_, bin_begin_, next_;
  Spheres spheres_;

  void find_near_owned(double distance);
  void sort(const SpatialBins &bins);

  /// Spheres of a row of bins follow each other.
  template <typename Function>
  void visit_row(int sphere, int begin, int end, const Function &f) const
  {
    const Spheres &all = spheres_;
    const float px = all.x[sphere], py = all.y[sphere], pz = all.z[sphere],
                far = static_cast<float>(reach_) + all.radius[sphere];
    const std::int32_t unseen = own_surfaces_ ? NearTriangles::NO_SURFACE : all.surface[sphere],
                       owned = all.owned[sphere];
    constexpr int most = 64;
    std::int32_t hit[most];    // as wide as all others in the loop
    for (int from = begin; from < end; from += most) {
      const int count = std::min(most, end - from);
      const float *const x = &all.x[from], *const y = &all.y[from], *const z = &all.z[from],
                         *const radius = &all.radius[from];
      const std::int32_t *const surface = &all.surface[from], *const here = &all.owned[from];
      for_each((count + AT_ONCE - 1) / AT_ONCE * AT_ONCE, [&](int n) {
        const float dx = x[n] - px, dy = y[n] - py, dz = z[n] - pz, reached = far + radius[n];
        hit[n] = (dx * dx + dy * dy + dz * dz <= reached * reached) & (surface[n] != unseen) &
                 ((owned | here[n]) != 0);
      });
      for (int group = 0; group < count; group += AT_ONCE) {
        std::int32_t any = 0;
        for (int n = 0; n < AT_ONCE; ++n) any |= hit[group + n];
        if (!any) continue;
        for (int n = group; n < std::min(group + AT_ONCE, count); ++n)
          if (hit[n]) f(all.fan[sphere], all.fan[from + n]);
      }
    }
  }
};

}    // namespace rbc
