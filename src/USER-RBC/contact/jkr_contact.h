#pragma once

namespace rbc {

/// A soft tip of radius R pressed into a flat by an overlap h, with Johnson, Kendall and Roberts' adhesion (1971) or,
/// without adhesion, as Hertz has it:
///   F = K a^3 / R - sqrt(6 pi sigma K a^3),   h = a^2 / R - (2/3) sqrt(6 pi sigma a / K)
/// with the radius a of the contact, the effective modulus K and the work of adhesion sigma. Of the two a that an h in
/// the tail may have, it is the stable one at fixed h. Force is positive where it repels, energy zero without contact.
///
/// A surface is covered by such tips, one on each tip_area(). This area is such that the work per area to separate two
/// surfaces from where the force vanishes is sigma, whatever K and R.
class TipContact {
 public:
  /// Nothing touches.
  TipContact() = default;

  static TipContact adhesive(double modulus, double work, double radius);
  static TipContact repulsive(double modulus, double radius);

  bool touches() const { return tip_area_ > 0; }
  double tip_radius() const { return tip_radius_; }
  double tip_area() const { return tip_area_; }
  double separation() const { return separation_; }      ///< overlap at which contact is lost
  double equilibrium() const { return equilibrium_; }    ///< overlap at which the force vanishes
  double pull_off() const { return pull_off_; }          ///< largest force of attraction

  /// For overlaps above separation().
  double contact_radius(double overlap) const;
  double force(double overlap) const;
  double energy(double overlap) const;
  double stiffness(double overlap) const;

  /// Force and energy per area of a surface covered by tips.
  struct PerArea {
    double traction, energy;
  };
  PerArea per_area(double overlap) const;

 private:
  double modulus_ = 0, tip_radius_ = 0, tip_area_ = 0;
  double zero_load_radius_ = 0;    // a0, none without adhesion
  double separation_ = 0, equilibrium_ = 0, pull_off_ = 0;

  double length_scale() const { return zero_load_radius_ * zero_load_radius_ / tip_radius_; }
  double root(double overlap) const;
  double scaled_force(double y) const;
  double scaled_energy(double y) const;
};

}    // namespace rbc
