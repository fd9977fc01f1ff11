#ifndef LMP_RBC_REGION_ENCLOSURE_H
#define LMP_RBC_REGION_ENCLOSURE_H

#include "geometry/enclosure.h"

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
  std::vector<rbc::Vec3> contacts(const rbc::Vec3 &x, double distance) const;
  std::vector<rbc::Vec3> contacts_inside(const rbc::Vec3 &x, double distance) const;
  std::vector<rbc::Vec3> contacts_outside(const rbc::Vec3 &x, double distance) const;
};

}    // namespace LAMMPS_NS

#endif
