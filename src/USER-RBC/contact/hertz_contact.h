#pragma once

#include "contact/contact_traction.h"
#include "geometry/law_table.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace rbc {

/// A soft tip of radius R pressed into a flat by an overlap h, without adhesion (Hertz, J. reine
/// angew. Math. 92 (1882) 156):
///   F = K a^3 / R,   a^2 = R h
/// with the radius a of the contact and the effective modulus K (force per area). A surface is
/// covered by such tips, one on each area pi R^2.
class HertzContact {
 public:
  static constexpr const char *name = "repulsive";
  static constexpr std::array<LawParameter, 2> parameters{
      {{"K", Bound::positive}, {"R", Bound::positive, true}}};

  HertzContact(double K, double R) : modulus_(K), tip_radius_(R), tip_area_(pi * R * R) {}

  // what each contact law has, see contact_laws.h

  double tip_radius() const { return tip_radius_; }
  double detachment_overlap() const { return 0; }
  double equilibrium_overlap() const { return 0; }
  double work_per_area() const { return 0; }
  double largest_adhesion() const { return 0; }
  std::string limit() const { return ""; }

  double force(double overlap) const
  {
    const double a = contact_radius(overlap);
    return modulus_ * (a * a * a) / tip_radius_;
  }
  double energy(double overlap) const { return 0.4 * force(overlap) * overlap; }
  ContactTraction per_area(double overlap) const
  {
    const double traction = force(overlap) / tip_area_;
    return {traction, 0.4 * traction * overlap};
  }

  // what only tests ask for

  double contact_radius(double overlap) const
  {
    return std::sqrt(tip_radius_ * std::max(overlap, 0.0));
  }

 private:
  static constexpr double pi = 3.14159265358979323846;

  double modulus_, tip_radius_, tip_area_;
};

}    // namespace rbc
