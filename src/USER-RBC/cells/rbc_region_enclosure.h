#ifndef LMP_RBC_REGION_ENCLOSURE_H
#define LMP_RBC_REGION_ENCLOSURE_H

#include "geometry/enclosure.h"

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {

/// A region of LAMMPS and what lies within an offset of its surface, or, with a negative offset,
/// the region without what lies that near to it. Points are taken into the box first.
class RegionEnclosure : public rbc::Enclosure {
 public:
  /// Whether a face of the region on a periodic side of the box is a part of its surface where the
  /// region goes on behind the side opposite.
  enum class PeriodicSides { closed, open };

  RegionEnclosure(class Region *region, class Domain *domain, double offset = 0,
                  PeriodicSides sides = PeriodicSides::closed) :
      region_(region),
      domain_(domain), offset_(offset), sides_(sides)
  {
  }

  bool contains(const rbc::Vec3 &x) const override;
  rbc::Vec3 inward(const rbc::Vec3 &x, double distance) const override;

 private:
  Region *region_;
  Domain *domain_;
  double offset_;
  PeriodicSides sides_;

  rbc::Vec3 wrapped(rbc::Vec3 x) const;
  bool region_contains(const rbc::Vec3 &x) const;
  bool goes_on(const rbc::Vec3 &x, const rbc::Vec3 &arm) const;
  std::vector<rbc::Vec3> contacts_inside(const rbc::Vec3 &x, double distance) const;
  int contacts_outside(const rbc::Vec3 &x, double distance) const;
};

/// What lies in all of several regions.
class CommonEnclosure : public rbc::Enclosure {
 public:
  explicit CommonEnclosure(const RegionEnclosure &first) : parts_{first} {}
  void add(const RegionEnclosure &part) { parts_.push_back(part); }

  bool contains(const rbc::Vec3 &x) const override
  {
    return std::all_of(parts_.begin(), parts_.end(),
                       [&x](const RegionEnclosure &part) { return part.contains(x); });
  }

  /// Of the first one that x is near to.
  rbc::Vec3 inward(const rbc::Vec3 &x, double distance) const override
  {
    for (const RegionEnclosure &part : parts_) {
      const rbc::Vec3 normal = part.inward(x, distance);
      if (!normal.isZero()) return normal;
    }
    return rbc::Vec3::Zero();
  }

 private:
  std::vector<RegionEnclosure> parts_;
};

}    // namespace LAMMPS_NS

#endif
