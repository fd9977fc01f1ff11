#pragma once

#include "fluid/advection.h"
#include "fluid/coupling.h"
#include "fluid/plates.h"
#include "fluid/regime.h"
#include "fluid/stokes_solver.h"

namespace fluid {

/// Flow around immersed boundaries on this rank's part of the grid. Without inertia it follows from the forces:
///   clear_force, spread, gather_force, solve, share_velocity, interpolate.
/// With inertia time goes on by steps, in the middle of which velocity and forces meet:
///   clear_force, spread, gather_force, start_step, share_velocity, interpolate, finish_step.
class Flow {
 public:
  /// Without markers (ghost_layers = 0) no memory is kept for forces, and no ghosts but those of differences.
  Flow(const Grid &grid, const Decomposition &decomposition, int ghost_layers,
       const Regime &regime);
  Flow(const Flow &) = delete;
  Flow &operator=(const Flow &) = delete;

  /// Of the time for which is solved: with inertia the middle of the step, then its end.
  Drive drive;

  void clear_force();

  /// Points, or sheets: surfaces with fluid on both sides, whose velocity is corrected for the kink of the flow that kernels
  /// round off, see sharpening().
  enum class As { points, sheets };

  /// Returns the first marker whose kernel leaves the ghost layers (nothing is spread for it), or -1. Sheets take the
  /// outermost layer for differences.
  int spread(KernelKind kernel, const Markers &markers, const double *position, const double *force,
             double factor, As as = As::points);

  /// Adds the ghosts' share of the force to its owners: the exchange between spread and solve.
  void gather_force();

  void solve();

  /// Solves so far.
  long solves() const { return solves_; }

  /// From here to finish_step the velocity is that of the middle of the step. The first two steps of a flow are made
  /// of two halves by backward Euler, so that a sudden start does not ring (Rannacher, Numer. Math. 43 (1984) 309).
  void start_step(double dt);
  void finish_step();

  int steps() const { return steps_; }

  /// Fills the ghost layers of the velocity, unless they are: the exchange before interpolate.
  void share_velocity();

  /// Fills the ghost layers of the force; needed for output only.
  void share_force();

  void interpolate(KernelKind kernel, const Markers &markers, const double *position,
                   double *velocity, As as = As::points);

  /// Velocities at the markers that further forces on them would add now (solve, start_step): the mobility of the
  /// markers, by the coupled scheme. `add_response` adds a multiple of these forces and of their flow. The markers
  /// must be those of a spread that returned -1, at the same positions.
  void respond(KernelKind kernel, const Markers &markers, const double *position,
               const double *force, double *velocity, As as = As::points);
  void add_response(double factor);

  /// Adds a uniform velocity, ghosts included: triply periodic and without inertia only, where no force drives the mean.
  void add_mean(const Vec3 &velocity);

  const Grid &grid() const { return grid_; }
  const Regime &regime() const { return regime_; }
  const Decomposition &decomposition() const { return decomposition_; }
  const Box &brick() const { return decomposition_.mine(); }
  bool has_force() const { return has_force_; }
  const VectorField &force() const { return force_; }

  /// Over all cells of the grid. Collective.
  Vec3 mean_force() const;

  const VectorField &velocity() const { return velocity_; }

  /// Sets a velocity to start from, without divergence: velocity(c, i, j, k) on the brick's faces.
  template <typename Value> void set_velocity(Value value)
  {
    const auto u = velocity_.views();
    for (int c = 0; c < 3; ++c)
      for_each_cell(brick(), [&](int i, int j, int k) { u[c](i, j, k) = value(c, i, j, k); });
    shared_ = false;
  }

  /// Of the last solve or step: with inertia in its middle, and zero before the first step.
  const ScalarField &pressure();

  /// Force density (summed over this rank's cells) that went straight into a plate.
  const Vec3 &lower_direct() const { return lower_direct_; }
  const Vec3 &upper_direct() const { return upper_direct_; }

  /// What a flow with inertia remembers from step to step, of the whole grid, on rank 0; elsewhere empty. Collective.
  std::vector<double> history();
  std::size_t history_length() const;
  void restore(const double *history);

  /// Continues the flow of `old`, on whatever bricks. Collective.
  void take_over(Flow &old);

  Traffic traffic() const;
  std::size_t bytes() const;

 private:
  bool damped() const { return steps_ < 2; }
  void assemble(const VectorField &velocity, const VectorField &result) const;
  void set_shift(double shift);
  void solve_now(const VectorField &rhs);
  void solve_for(const VectorField &velocity, const VectorField &rhs, const Drive &by);
  void fill_ghosts(const VectorField &velocity, const Walls &walls);
  Box reach(As as) const;
  const VectorField &sharpened(KernelKind kernel, const VectorField &velocity, const Walls &walls);

  Grid grid_;
  Decomposition decomposition_;
  Regime regime_;
  Halo halo_;
  bool has_force_;
  long solves_ = 0;
  VectorField force_, velocity_;
  Drive solved_drive_;     ///< of the last solve
  Walls walls_;            ///< of the time of the velocity
  bool shared_ = false;    ///< the ghosts of the velocity are filled
  Vec3 lower_direct_{0, 0, 0}, upper_direct_{0, 0, 0};

  // with inertia
  int steps_ = 0;
  double shift_ = 0, dt_ = 0;
  VectorField previous_;    ///< velocity at the start of the step
  Walls previous_walls_;
  bool previous_shared_ = false;    ///< the ghosts of `previous_` are filled
  VectorField rhs_;         ///< of the momentum equation; without convection for the pressure only
  bool stepped_ = false;    ///< since construction

  ScalarField pressure_;
  VectorField response_force_, response_;
  VectorField sharp_;    ///< velocity of sheets
  Vec3 response_lower_{0, 0, 0}, response_upper_{0, 0, 0};
  StokesSolver solver_;
};

}    // namespace fluid
