#pragma once

#include <cmath>

namespace rbc {

/// Energy of a hinge and its derivative with respect to the angle.
struct HingeEnergy {
  double value, by_angle;
};

/// k_b (1 - cos(theta - theta0)) of the angle theta between the normals.
inline HingeEnergy dihedral_bending(double stiffness, double sine, double cosine, double rest_sine,
                                    double rest_cosine)
{
  return {stiffness * (1 - cosine * rest_cosine - sine * rest_sine),
          stiffness * (sine * rest_cosine - cosine * rest_sine)};
}

/// k_b with which equilateral triangles have the Helfrich modulus kappa, beside a Gaussian modulus
/// of -4/3 kappa (Seung & Nelson, Phys. Rev. A 38 (1988) 1005).
inline double dihedral_stiffness(double kappa)
{
  return 2 * kappa / std::sqrt(3.0);
}

/// theta0 for the spontaneous curvature c0 (sum of both principal curvatures): that of triangles
/// inscribed in a sphere of radius 2/c0, to second order in their size. `dual` is the distance
/// between their circumcentres.
inline double dihedral_rest_angle(double c0, double dual)
{
  return c0 / 2 * dual;
}

}    // namespace rbc
