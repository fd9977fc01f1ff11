#pragma once

#include "fluid/mobility_preconditioner.h"

#include <Eigen/Core>

#include <memory>

namespace fluid {

/// Markers of rigid no-slip surfaces that move as prescribed. The forces lambda that they exert on
/// the fluid obey A lambda = U - u. A is the mobility of the markers (spread, solve, interpolate),
/// U the velocity prescribed, u the velocity that the flow of all other forces has at the markers.
/// spread() adds forces extrapolated from the last two evaluations before the flow is solved.
/// enforce() then corrects them; each iteration costs one solve. An iteration has two parts: the
/// best combination of search directions kept from earlier iterations and evaluations, together
/// with A times each of them, and one new direction, the preconditioned residual. Without kept
/// directions this is the conjugate gradient method. Where the mean velocity c of a triply periodic
/// flow is free, it is a further unknown: A lambda + c = U - u and sum lambda = given. Search
/// directions then have no net force.
class RigidSurface {
 public:
  RigidSurface();
  ~RigidSurface();

  struct Settings {
    /// Largest slip allowed, relative to the largest speed. Markers also yield by their compliance
    /// (see MobilityPreconditioner); where that is larger than the tolerance, it bounds what is
    /// left beyond it.
    double tolerance = 1e-3;
    int max_solves = 100;    ///< of an evaluation, including the first
    int most_directions = 64;
    bool free_mean = false;

    /// Sheets hold the fluid where the markers are. Points hold it surface_offset() further into
    /// the fluid, and more, by a second-order part, where the surface is curved.
    MarkerKind kind = MarkerKind::points;
  };
  const Settings &settings() const { return settings_; }

  /// Takes effect with the next set_markers.
  void set_settings(const Settings &settings) { settings_ = settings; }

  /// New markers at new places, three numbers each; all that is known of others is forgotten.
  void set_markers(const Flow &flow, KernelKind kernel, int count, const double *position,
                   const int *body);

  /// The markers have moved, those of a body in parallel. Collective, like what follows.
  void move(const double *position);

  int count() const { return markers_.count; }
  KernelKind kernel() const { return markers_.kernel; }

  /// Rows as in set_markers: velocities wanted; forces on the fluid of the last evaluation and of
  /// that before it.
  double *target() { return target_.data(); }
  double *force() { return force_.data(); }
  double *earlier_force() { return earlier_.data(); }

  struct Times {
    double last = 0, earlier = 0;
    int known = 0;    ///< of the two
  };
  const Times &times() const { return times_; }
  void set_times(const Times &times) { times_ = times; }

  /// Times count from a later one from now on, by `span`.
  void shift_times(double span)
  {
    times_.last -= span;
    times_.earlier -= span;
  }

  /// Between clear_force and accumulate_ghosts of Flow: guesses the forces of a time and spreads
  /// them. `others` is the sum of this rank's share of all other forces; it counts for a free mean
  /// only. Returns what spread does.
  int spread(Flow &flow, double time, const Real3 &others);

  struct Outcome {
    int solves = 1;
    double slip = 0;    ///< largest at a marker, relative to the largest speed of fluid and markers
    bool converged = false;
  };

  /// Where the mean velocity is free: the one that the solve after spread() must be for; then,
  /// corrected by enforce().
  const Real3 &mean() const { return mean_; }

  /// After solve: corrects forces, flow and mean velocity. The ghosts of the velocity are filled.
  Outcome enforce(Flow &flow);

  /// From hold() on evaluations may be taken back: restore() forgets all that they have changed but
  /// target and flow, release() keeps it. Not collective.
  void hold();
  void restore();
  void release();

  /// Forgets the directions known, as after a move.
  void forget_directions() { known_ = 0; }

  /// What evaluations need of those before them: numbers that all ranks share, and so many of each
  /// marker, one marker after the other. The first three of a marker are its position at
  /// set_markers. With `directions` false less is kept, and the next evaluation takes longer.
  std::vector<double> shared_memory(bool directions) const;
  int memory_of_marker(bool directions) const { return 3 * (3 + 2 * (directions ? known_ : 0)); }
  std::vector<double> marker_memory(bool directions) const;

  /// Takes that up again after set_markers at these positions, and move where markers have moved
  /// since.
  void remember(const std::vector<double> &shared, const std::vector<double> &of_markers);

  std::size_t bytes() const;

 private:
  using Vector = Eigen::VectorXd;
  using Columns = Eigen::MatrixXd;

  Settings settings_;
  Times times_;
  std::vector<int> index_;
  MarkerSet markers_;
  MobilityPreconditioner preconditioner_;

  Vector built_, position_, target_, force_, earlier_, compliance_step_, compliance_;
  Vector residual_, step_, response_, direction_, change_;
  Real3 mean_{0, 0, 0};

  // net force: forces of the preconditioner for unit velocities, and the inverse of their sums
  Eigen::Matrix<double, Eigen::Dynamic, 3> uniform_;
  Eigen::Matrix3d drag_;

  // directions known: A-orthonormal, with their responses and how much they were of use lately
  Columns directions_, responses_;
  Vector use_, shares_;
  int known_ = 0;
  struct Held;
  std::unique_ptr<Held> held_;    ///< null but between hold() and restore() or release()

  /// Optimal step length along the preconditioned residual, found in the previous iteration.
  double length_ = 1;

  /// How large residuals may be. The slip is the residual and what markers yield.
  struct Limit {
    double allowed;
    bool holds(double residual, double slip) const;
  };

  bool improve(Flow &flow, const Limit &limit, bool first);
  void combine_known_directions(const Flow &flow, bool first);
  double find_new_direction(const Flow &flow);
  void apply_step(Flow &flow);
  void precondition(const Flow &flow, const Vector &velocity, Vector &force);
  Eigen::Vector3d uniform_part(const Flow &flow, const Vector &velocity) const;
  void add_direction(double scale);
  void keep_column(int place);
  void add_mean(Flow &flow, Real3 &change);
};

}    // namespace fluid
