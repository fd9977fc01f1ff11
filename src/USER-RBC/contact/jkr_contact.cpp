#include "contact/jkr_contact.h"

#include <algorithm>
#include <cmath>

namespace rbc {

// With adhesion everything follows from y = sqrt(a / a0), a0 = (6 pi sigma R^2 / K)^(1/3) the contact's radius at zero
// load, and the scales a0^2 / R of lengths, pi sigma R = K a0^3 / (6 R) of forces:
//   h = y^4 - (2/3) y,   F = 6 (y^6 - y^3),   U = (12/5) y^10 - 4 y^7 + y^4 - U_0
// Contact is lost where dh/dy = 0: y^3 = 1/6, h = -y/2, U = 0.

namespace {

constexpr double pi = 3.14159265358979323846;

double cube(double s)
{
  return s * s * s;
}

const double separation_root = std::cbrt(1.0 / 6);
const double separation_energy = 0.4 * std::pow(separation_root, 4);    // U_0
const double well_depth = 0.6 + separation_energy;                      // -U at zero load, y = 1
constexpr double deepest_pull = 1.5;                                    // at y^3 = 1/2

/// Solves 6 q^2 + 4 q^3 + q^4 = s^2: of h above separation in units of separation_root^4, with
/// y = separation_root (1 + q). Newton's method for q sqrt(6 + 4 q + q^2) = s, which is nearly linear in q where the
/// quartic has a double root.
double excess_root(double s)
{
  double q = s / std::sqrt(6 + 1.5 * s);    // within 17 %; after four steps below 1e-16
  for (int n = 0; n < 4; ++n) {
    const double w = 6 + q * (4 + q), root = std::sqrt(w);
    q -= (q * root - s) * root / (6 + q * (6 + 2 * q));
  }
  return q;
}

}    // namespace

TipContact TipContact::adhesive(double modulus, double work, double radius)
{
  TipContact tip;
  tip.modulus_ = modulus;
  tip.tip_radius_ = radius;
  const double a0 = std::cbrt(6 * pi * work * radius * radius / modulus);
  tip.zero_load_radius_ = a0;
  tip.tip_area_ = well_depth * pi * a0 * a0;
  tip.separation_ = -separation_root / 2 * tip.length_scale();
  tip.equilibrium_ = tip.length_scale() / 3;
  tip.pull_off_ = deepest_pull * pi * work * radius;
  return tip;
}

TipContact TipContact::repulsive(double modulus, double radius)
{
  TipContact tip;
  tip.modulus_ = modulus;
  tip.tip_radius_ = radius;
  tip.tip_area_ = pi * radius * radius;
  return tip;
}

double TipContact::root(double overlap) const
{
  const double excess = std::max(overlap - separation_, 0.0) / length_scale();
  return separation_root *
         (1 + excess_root(std::sqrt(excess) / (separation_root * separation_root)));
}

double TipContact::scaled_force(double y) const
{
  const double y3 = cube(y);
  return y3 * (y3 - 1) * modulus_ * cube(zero_load_radius_) / tip_radius_;
}

double TipContact::scaled_energy(double y) const
{
  const double y3 = cube(y);
  return (y * y3 * (y3 * (2.4 * y3 - 4) + 1) - separation_energy) * modulus_ *
         cube(zero_load_radius_) / (6 * tip_radius_) * length_scale();
}

double TipContact::contact_radius(double overlap) const
{
  if (zero_load_radius_ == 0) return std::sqrt(tip_radius_ * std::max(overlap, 0.0));
  const double y = root(overlap);
  return zero_load_radius_ * y * y;
}

double TipContact::force(double overlap) const
{
  if (zero_load_radius_ > 0) return scaled_force(root(overlap));
  return modulus_ * cube(contact_radius(overlap)) / tip_radius_;
}

double TipContact::energy(double overlap) const
{
  if (zero_load_radius_ > 0) return scaled_energy(root(overlap));
  return 0.4 * force(overlap) * overlap;
}

double TipContact::stiffness(double overlap) const
{
  if (zero_load_radius_ == 0) return 1.5 * modulus_ * contact_radius(overlap);
  const double y = root(overlap), y3 = cube(y);
  return modulus_ * zero_load_radius_ * y * y * (3 * y3 - 1.5) / (2 * y3 - 1.0 / 3);
}

TipContact::PerArea TipContact::per_area(double overlap) const
{
  if (zero_load_radius_ == 0) {
    const double traction = force(overlap) / tip_area_;
    return {traction, 0.4 * traction * overlap};
  }
  const double y = root(overlap);
  return {scaled_force(y) / tip_area_, scaled_energy(y) / tip_area_};
}

}    // namespace rbc
