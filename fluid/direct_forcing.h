#pragma once

#include "fluid/flow.h"

namespace fluid {

/// Markers with mass, which move with the fluid. They pass on to it the force applied to them less
/// what accelerates their mass: with U the velocity of the fluid at the markers in the middle of a
/// step they exert
///   F - W (U - V),
/// where the resistance W = mass / time and the velocity V come from the discretisation of the
/// acceleration. With U = U_F + M (force), M the mobility of the markers, the inertial force mu =
/// -W (U - V) = sqrt(W) z obeys
///   (1 + sqrt(W) M sqrt(W)) z = sqrt(W) (V - U_F),
/// which is solved by conjugate gradients with one solve of the flow each. Without mass nothing is
/// left to solve; with a very large one the markers hold V, as a rigid no-slip surface (the direct
/// forcing of Xu et al., equations 5 and 6). Where no resistance is given they do hold V: M mu = V
/// - U_F.
class DirectForcing {
 public:
  double tolerance = 1e-4;
  int max_solves = 100;

  /// Arrays have three numbers a row, `resistance` has one, for rows as the markers count.
  struct Problem {
    MarkerSet markers;
    const double *applied;
    const double *resistance;    ///< or null
    const double *target;
    double *inertial;    ///< a guess that becomes the inertial force
    double *velocity;    ///< becomes U
    int rows;

    bool massive() const { return resistance != nullptr; }
    double weight(int row) const { return massive() ? resistance[row] : 1.0; }
  };

  struct Outcome {
    int outside = -1;    ///< marker whose kernel leaves the ghost layers: nothing else is valid
    int solves = 1;
    /// Of the force relative to the largest part of it, or of the velocity relative to the fastest
    /// fluid, whichever is less.
    double error = 0;
  };

  /// Takes the place of clear_force .. interpolate of Flow; dt counts with inertia only.
  Outcome advance(Flow &flow, double dt, const Forcing &forcing, const Problem &problem);

  std::size_t bytes() const { return 5 * total_.capacity() * sizeof(double); }

 private:
  /// Squares, summed over all markers.
  struct Sums {
    double residual, as_force, as_velocity;    ///< the residual z, as a force, as a velocity
    double force;
    double numbers;    ///< how many numbers were summed
  };

  std::vector<double> total_, residual_, direction_, scaled_, response_;

  /// Returns whether the kernels of all markers stay within the ghost layers; else `outside` is one
  /// of this rank's that does not, or -1.
  bool solve_for_guess(Flow &flow, double dt, const Forcing &forcing, const Problem &problem,
                       int &outside);
  Sums sums(const Flow &flow, const Problem &problem) const;
  void conjugate_gradient_step(Flow &flow, const Problem &problem, double square);
};

}    // namespace fluid
