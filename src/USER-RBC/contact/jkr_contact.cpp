#include "contact/jkr_contact.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rbc {

// Everything follows from y = sqrt(a / a0) and from two scales. a0 = (6 pi sigma R^2 / K)^(1/3) is
// the radius of the contact at zero load, a0^2 / R the scale of lengths, and pi sigma R = K a0^3 /
// (6 R) that of forces:
//   h = y^4 - (2/3) y,   F = 6 (y^6 - y^3),   U = (12/5) y^10 - 4 y^7 + y^4 - U_0
// Contact is lost where dh/dy = 0: y^3 = 1/6, h = -y/2, U = 0.

namespace {

constexpr double pi = 3.14159265358979323846;

double cube(double s)
{
  return s * s * s;
}

const double detachment_root = std::cbrt(1.0 / 6);
const double detachment_energy = 0.4 * std::pow(detachment_root, 4);    // U_0
const double well_depth = 0.6 + detachment_energy;                      // -U at zero load, y = 1
constexpr double deepest_pull = 1.5;                                    // at y^3 = 1/2

/// Solves 6 q^2 + 4 q^3 + q^4 = s^2 by four steps of Newton's method. s^2 is the distance of h from
/// detachment in units of detachment_root^4, and y = detachment_root (1 + q). The steps are for
/// q sqrt(6 + 4 q + q^2) = s, which is nearly linear in q where the quartic has a double root.
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

JkrContact::JkrContact(double K, double sigma, double R) :
    modulus_(K), work_(sigma), tip_radius_(R),
    zero_load_radius_(std::cbrt(6 * pi * sigma * R * R / K)),
    tip_area_(well_depth * pi * zero_load_radius_ * zero_load_radius_),
    detachment_(-detachment_root / 2 * length_scale()), equilibrium_(length_scale() / 3),
    pull_off_(deepest_pull * pi * sigma * R)
{
}

/// The equilibrium overlap is tip_radius() at this ratio.
std::string JkrContact::limit() const
{
  char text[64];
  std::snprintf(text, sizeof text, "sigma/K must be < %.6g",
                std::sqrt(3.0) / (2 * pi) * tip_radius_);
  return text;
}

double JkrContact::root(double overlap) const
{
  const double excess = std::max(overlap - detachment_, 0.0) / length_scale();
  return detachment_root *
         (1 + excess_root(std::sqrt(excess) / (detachment_root * detachment_root)));
}

double JkrContact::scaled_force(double y) const
{
  const double y3 = cube(y);
  return y3 * (y3 - 1) * modulus_ * cube(zero_load_radius_) / tip_radius_;
}

double JkrContact::scaled_energy(double y) const
{
  const double y3 = cube(y);
  return (y * y3 * (y3 * (2.4 * y3 - 4) + 1) - detachment_energy) * modulus_ *
         cube(zero_load_radius_) / (6 * tip_radius_) * length_scale();
}

double JkrContact::contact_radius(double overlap) const
{
  const double y = root(overlap);
  return zero_load_radius_ * y * y;
}

double JkrContact::force(double overlap) const
{
  return scaled_force(root(overlap));
}

double JkrContact::energy(double overlap) const
{
  return scaled_energy(root(overlap));
}

ContactTraction JkrContact::per_area(double overlap) const
{
  const double y = root(overlap);
  return {scaled_force(y) / tip_area_, scaled_energy(y) / tip_area_};
}

}    // namespace rbc
