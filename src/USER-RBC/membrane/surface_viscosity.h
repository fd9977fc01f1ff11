#pragma once

namespace rbc {

/// Shear viscosity of a membrane (force time / length) at a rate of shear, from `slow` at rest to
/// `fast`: half of the fall is at `rate` (Cross, J. Colloid Sci. 20 (1965) 417, with exponent 1).
class SurfaceViscosity {
 public:
  SurfaceViscosity(double constant = 0) : slow_(constant), fast_(constant) {}
  SurfaceViscosity(double slow, double fast, double rate) : slow_(slow), fast_(fast), rate_(rate) {}

  bool is_zero() const { return slow_ == 0; }
  bool thins() const { return fast_ < slow_; }
  double at_rest() const { return slow_; }

  double operator()(double shear) const { return fast_ + (slow_ - fast_) / (1 + shear / rate_); }
  double slope(double shear) const
  {
    const double bend = 1 + shear / rate_;
    return -(slow_ - fast_) / (rate_ * bend * bend);
  }

 private:
  double slow_, fast_, rate_ = 1;
};

}    // namespace rbc
