#ifndef LMP_RBC_REGION_ENCLOSURE_H
#define LMP_RBC_REGION_ENCLOSURE_H

#include "geometry/enclosure.h"

namespace LAMMPS_NS {

/// A region of LAMMPS and what lies within an offset of its surface, or, with a negative offset,
/// the region without what lies that near to it. Points are taken into the box first.
class RegionEnclosure : public rbc::Enclosure {
 public:
  RegionEnclosure(class Region *region, class Domain *domain, double offset = 0) :
      region_(region), domain_(domain), offset_(offset)
  {
  }

  bool contains(const rbc::Vec3 &x) const override;
  rbc::Vec3 inward(const rbc::Vec3 &x, double distance) const override;

 private:
  Region *region_;
  Domain *domain_;
  double offset_;

  rbc::Vec3 wrapped(rbc::Vec3 x) const;
  bool region_contains(const rbc::Vec3 &x) const;
  int contacts_outside(const rbc::Vec3 &x, double distance) const;
};

}    // namespace LAMMPS_NS

#endif
