#include "cells/rbc_region_enclosure.h"

#include "domain.h"
#include "region.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using rbc::Vec3;

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
   Returns how many contacts a point outside has with the surface within `distance`. LAMMPS finds
   them from the inside of the inverted region, so `interior` is inverted for the call.
------------------------------------------------------------------------- */

int RegionEnclosure::contacts_outside(const Vec3 &x, double distance) const
{
  region_->interior ^= 1;
  const int count = region_->surface(x[0], x[1], x[2], distance);
  region_->interior ^= 1;
  return count;
}

/* ---------------------------------------------------------------------- */

bool RegionEnclosure::contains(const Vec3 &x) const
{
  const Vec3 y = wrapped(x);
  if (region_contains(y)) return offset_ >= 0 || region_->surface(y[0], y[1], y[2], -offset_) == 0;
  return offset_ > 0 && contacts_outside(y, offset_) > 0;
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
  const int count = in ? region_->surface(y[0], y[1], y[2], reach) : contacts_outside(y, reach);
  double nearest = HUGE_VAL;
  for (int n = 0; n < count; ++n) nearest = std::min(nearest, region_->contact[n].r);
  Vec3 normal = Vec3::Zero();
  for (int n = 0; n < count; ++n) {
    const Region::Contact &contact = region_->contact[n];
    const Vec3 arm(contact.delx, contact.dely, contact.delz);
    if (contact.r <= nearest + distance && arm.norm() > 0) normal += arm.normalized();
  }
  if (!(normal.norm() > 0)) return Vec3::Zero();
  return (in ? 1 : -1) * normal.normalized();
}
