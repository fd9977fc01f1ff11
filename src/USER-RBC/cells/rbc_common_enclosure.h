#ifndef LMP_RBC_COMMON_ENCLOSURE_H
#define LMP_RBC_COMMON_ENCLOSURE_H

#include "cells/rbc_region_enclosure.h"

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {

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
