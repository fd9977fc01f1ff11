#include "cells/rbc_region_enclosure.h"

#include "domain.h"
#include "region.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::Vec3;

static constexpr double JUST_BEYOND = 1e-6;    // a surface, in longest sides of the box

/* ---------------------------------------------------------------------- */

Vec3 RegionEnclosure::wrapped(Vec3 x) const
{
  domain_->remap(x.data());
  return x;
}

bool RegionEnclosure::region_contains(const Vec3 &x) const
{
  return region_->match(x[0], x[1], x[2]);
}

/* ----------------------------------------------------------------------
   Returns the contacts of a point inside with the surface within `distance`, as vectors from the
   surface.
------------------------------------------------------------------------- */

std::vector<Vec3> RegionEnclosure::contacts(const Vec3 &x, double distance) const
{
  const int count = region_->surface(x[0], x[1], x[2], distance);
  std::vector<Vec3> arms;
  for (int n = 0; n < count; ++n) {
    const Region::Contact &contact = region_->contact[n];
    arms.emplace_back(contact.delx, contact.dely, contact.delz);
  }
  return arms;
}

/* ----------------------------------------------------------------------
   The same of a point outside. LAMMPS finds them from the inside of the inverted region, so
   `interior` is inverted for the call.
------------------------------------------------------------------------- */

std::vector<Vec3> RegionEnclosure::contacts_outside(const Vec3 &x, double distance) const
{
  region_->interior ^= 1;
  std::vector<Vec3> arms = contacts(x, distance);
  region_->interior ^= 1;
  return arms;
}

/* ----------------------------------------------------------------------
   Tells whether a point inside lies off a face on a periodic side behind which the region goes on.
   `arm` leads to it from the face.
------------------------------------------------------------------------- */

bool RegionEnclosure::goes_on(const Vec3 &x, const Vec3 &arm) const
{
  if (sides_ == PeriodicSides::closed || arm.isZero(0)) return false;
  const double beyond = JUST_BEYOND * Vec3(domain_->prd).maxCoeff();
  return region_contains(wrapped(x - arm - beyond * arm.normalized()));
}

/* ----------------------------------------------------------------------
   The contacts of a point inside, but for faces behind which the region goes on.
------------------------------------------------------------------------- */

std::vector<Vec3> RegionEnclosure::contacts_inside(const Vec3 &x, double distance) const
{
  std::vector<Vec3> arms = contacts(x, distance);
  arms.erase(
      std::remove_if(arms.begin(), arms.end(), [&](const Vec3 &arm) { return goes_on(x, arm); }),
      arms.end());
  return arms;
}

/* ---------------------------------------------------------------------- */

bool RegionEnclosure::contains(const Vec3 &x) const
{
  const Vec3 y = wrapped(x);
  if (region_contains(y)) return offset_ >= 0 || contacts_inside(y, -offset_).empty();
  return offset_ > 0 && !contacts_outside(y, offset_).empty();
}

/* ----------------------------------------------------------------------
   Returns the mean inward normal of all parts of the surface whose distance is at most that of the
   nearest plus `distance`; zero if there is none.
------------------------------------------------------------------------- */

Vec3 RegionEnclosure::inward(const Vec3 &x, double distance) const
{
  const Vec3 y = wrapped(x);
  const bool in = region_contains(y);
  const double reach = std::abs(offset_) + distance;
  const std::vector<Vec3> arms = in ? contacts_inside(y, reach) : contacts_outside(y, reach);
  double nearest = HUGE_VAL;
  for (const Vec3 &arm : arms) nearest = std::min(nearest, arm.norm());
  Vec3 normal = Vec3::Zero();
  for (const Vec3 &arm : arms)
    if (arm.norm() <= nearest + distance && arm.norm() > 0) normal += arm.normalized();
  if (!(normal.norm() > 0)) return Vec3::Zero();
  return (in ? 1 : -1) * normal.normalized();
}
