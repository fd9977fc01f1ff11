#pragma once

#include "contact/contact_traction.h"
#include "geometry/law_table.h"

#include <string>

namespace rbc {

/// A soft tip of radius R pressed into a flat by an overlap h, with the adhesion of Johnson,
/// Kendall and Roberts (Proc. R. Soc. A 324 (1971) 301):
///   F = K a^3 / R - sqrt(6 pi sigma K a^3),   h = a^2 / R - (2/3) sqrt(6 pi sigma a / K)
/// with the radius a of the contact, the effective modulus K (force per area) and the work of
/// adhesion sigma (energy per area). An h below zero has two solutions a; this is the one that is
/// stable at fixed h. The force is positive where it repels; the energy is zero without contact.
///
/// A surface is covered by such tips, one on each tip_area(). This area is such that the work per
/// area to separate two surfaces from where the force vanishes is sigma, whatever K and R.
class JkrContact {
 public:
  static constexpr const char *name = "adhesive";
  static constexpr std::array<LawParameter, 3> parameters{
      {{"K", Bound::positive}, {"sigma", Bound::positive}, {"R", Bound::positive, true}}};

  JkrContact(double K, double sigma, double R);

  // what each contact law has, see contact_laws.h

  double tip_radius() const { return tip_radius_; }
  double detachment_overlap() const { return detachment_; }
  double equilibrium_overlap() const { return equilibrium_; }
  double work_per_area() const { return work_; }
  double largest_adhesion() const { return pull_off_ / tip_area_; }
  std::string limit() const;

  double force(double overlap) const;
  double energy(double overlap) const;
  ContactTraction per_area(double overlap) const;

  // what only this law has, and tests compare with published curves

  double tip_area() const { return tip_area_; }
  double pull_off() const { return pull_off_; }    ///< largest force of attraction of a tip
  double contact_radius(double overlap) const;

 private:
  double modulus_, work_, tip_radius_;
  double zero_load_radius_;    ///< a0, the radius of the contact where the force vanishes
  double tip_area_, detachment_, equilibrium_, pull_off_;

  double length_scale() const { return zero_load_radius_ * zero_load_radius_ / tip_radius_; }
  double root(double overlap) const;
  double scaled_force(double y) const;
  double scaled_energy(double y) const;
};

}    // namespace rbc
