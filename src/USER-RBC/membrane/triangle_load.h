#pragma once

#include "geometry/plain_vector.h"

namespace rbc {

/// What acts on a triangle with the edges e1 and e2 out of its corner 0, summed up to forces on
/// its corners. Each part adds minus the gradient of an energy.
class TriangleLoad {
 public:
  TriangleLoad(PlainVector e1, PlainVector e2, PlainVector normal, double twice_area) :
      e1_(e1), e2_(e2), normal_(normal), twice_area_(twice_area), m11_(dot(e1, e1)),
      m12_(dot(e1, e2)), m22_(dot(e2, e2))
  {
  }

  /// g11 m11 + 2 g12 m12 + g22 m22 of the metric m of the triangle.
  double contract(double g11, double g12, double g22) const
  {
    return g11 * m11_ + 2 * g12 * m12_ + g22 * m22_;
  }

  /// Derivatives of the energy with respect to the metric: half that for m12.
  void add_metric(double by_m11, double by_m12, double by_m22)
  {
    s11_ += 2 * by_m11;
    s12_ += 2 * by_m12;
    s22_ += 2 * by_m22;
  }

  /// Derivative with respect to the area.
  void add_tension(double tension)
  {
    const double half = tension / (2 * twice_area_);
    s11_ += half * m22_;
    s12_ -= half * m12_;
    s22_ += half * m11_;
  }

  /// Outward force per area.
  void add_pressure(double pressure)
  {
    const double third = pressure * twice_area_ / 6;
    n0_ += third;
    n1_ += third;
    n2_ += third;
  }

  /// Derivatives with respect to the angles of the edges that face each corner, over the edge's
  /// length.
  void add_moments(double by_angle0, double by_angle1, double by_angle2)
  {
    const double p0 = by_angle0 / twice_area_, p1 = by_angle1 / twice_area_,
                 p2 = by_angle2 / twice_area_;
    const double at1 = m11_ - m12_,
                 at2 = m22_ - m12_;    // dot products of the edges at corners 1, 2
    n0_ += p0 * (at1 + at2) - p1 * at2 - p2 * at1;
    n1_ += p1 * m22_ - p2 * m12_ - p0 * at2;
    n2_ += p2 * m11_ - p0 * at1 - p1 * m12_;
  }

  /// Derivatives with respect to the lengths of the edges that face each corner, over the length.
  /// Of the two triangles at an edge each takes half.
  void add_pulls(double by_length0, double by_length1, double by_length2)
  {
    s11_ += by_length2 + by_length0;
    s12_ -= by_length0;
    s22_ += by_length1 + by_length0;
  }

  PlainVector corner0() const { return n0_ * normal_ + (s11_ + s12_) * e1_ + (s12_ + s22_) * e2_; }
  PlainVector corner1() const { return n1_ * normal_ - (s11_ * e1_ + s12_ * e2_); }
  PlainVector corner2() const { return n2_ * normal_ - (s12_ * e1_ + s22_ * e2_); }

 private:
  PlainVector e1_, e2_, normal_;
  double twice_area_;
  double m11_, m12_, m22_;                ///< metric
  double s11_ = 0, s12_ = 0, s22_ = 0;    ///< in its plane, see corner1() and corner2()
  double n0_ = 0, n1_ = 0, n2_ = 0;       ///< along the normal, on each corner
};

}    // namespace rbc
