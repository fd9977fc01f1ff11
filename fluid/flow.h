#pragma once

#include "fluid/advection.h"
#include "fluid/double_layer.h"
#include "fluid/flow_equations.h"
#include "fluid/plates.h"
#include "fluid/sheet_velocity.h"
#include "fluid/spreading.h"
#include "fluid/stokes_solver.h"

namespace fluid {

/// Flow around immersed boundaries on this rank's part of the grid. Without inertia it follows from
/// the forces:
///   clear_force, spread, accumulate_ghosts, solve, fill_ghosts, interpolate.
/// With inertia time goes on by steps, in the middle of which velocity and forces meet:
///   clear_force, spread, accumulate_ghosts, start_step, fill_ghosts, interpolate, finish_step.
class Flow {
 public:
  /// Without markers (ghost_layers = 0) no memory is kept for forces, and no ghosts but those of
  /// differences. Where markers are known to be sheets, these share memory with the solver.
  Flow(const Grid &grid, const Decomposition &decomposition, int ghost_layers,
       const FlowEquations &equations, bool sheets = false);
  Flow(const Flow &) = delete;
  Flow &operator=(const Flow &) = delete;

  void clear_force();

  /// Adds `factor` times the forces of the markers (three numbers a row) to the force density.
  /// Stops at the first marker whose kernel leaves the ghost layers and returns its row, or -1. For
  /// sheets the kernels must stay SheetVelocity::layers further inside. Not collective.
  int spread(const MarkerSet &markers, const double *force, double factor);

  /// Adds the double layer of markers of the kind layers; without inertia. The velocity solved for
  /// is then that of the fluid times the relative viscosity, see DoubleLayer, and so is the mean
  /// velocity of the forcing. Returns what spread does. Not collective.
  int spread(const MarkerSet &markers, const DoubleLayer &layer);

  /// The rate at which fluid appears in each cell of the brick, per volume, from the next solve on:
  /// the divergence of the velocity. Zero at first. What it sums to over the grid is taken evenly
  /// from all cells. Without inertia. The first call takes memory; on all ranks or none.
  ScalarField &supply();

  /// No fluid appears from now on.
  void end_supply();

  /// Adds the ghosts' share of the force to its owners: the exchange between spread and solve.
  void accumulate_ghosts();

  /// Computes the velocity from forces and forcing; for flow without inertia. Collective. The
  /// ghosts of the velocity are not filled.
  void solve(const Forcing &forcing);

  /// Solves so far.
  long solves() const { return solves_; }

  /// With inertia. The forcing is that of the middle of the step, t + dt/2. From here to
  /// finish_step the velocity is that of the middle. The first two steps of a flow are made of two
  /// halves by backward Euler, so that a sudden start does not ring (Rannacher, Numer. Math. 43
  /// (1984) 309).
  void start_step(double dt, const Forcing &forcing);

  /// The forcing is that of the end of the step, t + dt.
  void finish_step(const Forcing &forcing);

  int steps() const { return steps_; }

  /// Fills the ghost layers of the velocity, unless they are: the exchange before interpolate.
  void fill_ghosts();

  /// Fills the ghost layers of the force; needed for output only.
  void fill_force_ghosts();

  void interpolate(const MarkerSet &markers, double *velocity);

  /// Computes the velocities that further forces on the markers would add to theirs, after solve or
  /// start_step; by the coupled scheme. Costs a solve; the flow itself stays as it is. Returns the
  /// first marker whose kernel leaves the ghost layers, or -1; the velocities are valid only if all
  /// ranks return -1. Collective. add_mobility_flow() then adds `factor` times these forces and
  /// their flow to the flow.
  /// With `layer` the double layer of these velocities adds to the flow; `mean` is the mean of what
  /// is solved for. Forces may then be left out: all ranks do or none does.
  int apply_mobility(const MarkerSet &markers, const double *force, double *velocity,
                     const DoubleLayer *layer = nullptr, const Real3 &mean = {0, 0, 0},
                     bool with_forces = true);
  void add_mobility_flow(double factor);

  /// Finds the function of space that is zero outside of closed surfaces of markers and falls
  /// across them, in the direction of their outward normal, by the length of `step` over the area:
  /// rows as the markers', a number times area times normal. `mean` is its mean over the grid. Sets
  /// the function at the centres of the brick's cells. Costs a solve. Returns what spread does;
  /// valid if that is -1 on all ranks. Collective.
  int find_inside(const MarkerSet &markers, const double *step, double mean,
                  const ScalarField &inside);

  /// Takes this function, for these double layers, as the relative viscosity less 1 that
  /// fluid_velocity() needs. Values beyond `bounds`, to which it overshoots, are cut off.
  int find_excess(const MarkerSet &markers, const double *step, double mean,
                  const std::array<double, 2> &bounds);

  /// Adds a uniform velocity, ghosts included: triply periodic and without inertia only, where no
  /// force drives the mean.
  void add_mean(const Real3 &velocity);

  const Grid &grid() const { return grid_; }
  const FlowEquations &equations() const { return equations_; }
  const Decomposition &decomposition() const { return decomposition_; }
  const Box &brick() const { return decomposition_.mine(); }
  bool has_force() const { return has_force_; }
  const VectorField &force() const { return total_.force; }

  /// Over all cells of the grid. Collective.
  Real3 mean_force() const;

  const VectorField &velocity() const { return total_.velocity; }

  /// The velocity of the fluid on the brick and the faces around it: velocity() with its ghosts
  /// filled, but with double layers that over the relative viscosity of the last find_excess().
  /// Valid until the flow changes. Collective.
  const VectorField &fluid_velocity();

  /// Divergence of velocity() that double layers and the supply ask for, null without.
  const ScalarField *source() const { return total_.layered ? &total_.source : supplied(); }

  /// Sets a velocity to start from, without divergence: velocity(c, i, j, k) on the brick's faces.
  template <typename Value> void set_velocity(Value value)
  {
    const auto u = total_.velocity.views();
    for (int c = 0; c < 3; ++c)
      for_each_cell(brick(), [&](int i, int j, int k) { u[c](i, j, k) = value(c, i, j, k); });
    shared_ = false;
  }

  /// Pressure of the last solve or step, with inertia that in the middle of the step; zero before
  /// the first step. Costs a solve, and memory at the first call. Collective.
  const ScalarField &pressure();

  /// Force density (summed over this rank's cells) that went straight into a plate.
  const Real3 &lower_direct() const { return total_.into_lower; }
  const Real3 &upper_direct() const { return total_.into_upper; }

  /// What a flow with inertia remembers from step to step, of the whole grid, on rank 0; elsewhere
  /// empty. Collective.
  std::vector<double> history();
  std::size_t history_length() const;
  void restore(const double *history);

  /// Continues the flow of `old`, on whatever bricks. Collective.
  void take_over(Flow &old);

  Traffic traffic() const;
  std::size_t bytes() const;

 private:
  /// Forces and the velocity that they give, with what of the forces goes straight into the plates.
  struct ForcedVelocity {
    VectorField force, velocity;
    VectorField to_correct;    ///< forces of markers that are layers; empty before the first
    ScalarField source;        ///< of double layers; empty before the first
    bool corrected = false;    ///< there are such forces
    bool layered = false;      ///< there are double layers
    KernelKind kernel = default_kernel;    ///< of the forces to correct
    Real3 into_lower{0, 0, 0}, into_upper{0, 0, 0};

    void clear_force()
    {
      force.clear();
      if (corrected) to_correct.clear();
      if (layered) source.clear();
      corrected = layered = false;
      into_lower = into_upper = {0, 0, 0};
    }
  };

  bool damped() const { return steps_ < 2; }
  const ScalarField *supplied() const { return is_supplied_ ? &supply_ : nullptr; }
  void assemble(const VectorField &velocity, const VectorField &result) const;
  void set_shift(double shift);
  void solve_now(const VectorField &rhs, const Forcing &forcing);
  void solve_for(const VectorField &velocity, const VectorField &rhs, const Forcing &forcing,
                 const ScalarField *source = nullptr);
  int spread(const MarkerSet &markers, const double *force, double factor, ForcedVelocity &flow);
  int spread(const MarkerSet &markers, const DoubleLayer &layer, ForcedVelocity &flow);
  void add_corrected(ForcedVelocity &flow);
  void take_layers(const Flow &old);
  void accumulate_ghosts_of(ForcedVelocity &flow);
  void fill_ghosts_of(const VectorField &velocity, const PlateVelocities &plates);
  Box reach(MarkerKind kind) const;
  const VectorField &seen_by(const MarkerSet &markers, const VectorField &velocity,
                             const PlateVelocities &plates);

  Grid grid_;
  Decomposition decomposition_;
  FlowEquations equations_;
  Halo halo_;
  bool has_force_;
  long solves_ = 0;
  ForcedVelocity total_;
  Forcing solved_forcing_;    ///< of the last solve
  PlateVelocities plates_;    ///< of the time of the velocity
  bool shared_ = false;       ///< the ghosts of the velocity are filled

  // with inertia
  int steps_ = 0;
  double shift_ = 0, dt_ = 0;
  VectorField previous_;    ///< velocity at the start of the step
  PlateVelocities previous_plates_;
  bool previous_shared_ = false;    ///< the ghosts of `previous_` are filled
  VectorField rhs_;         ///< of the momentum equation; without convection for the pressure only
  bool stepped_ = false;    ///< start_step() was called since construction or restore()

  bool is_supplied_ = false;
  ScalarField supply_;    ///< empty before the first call of supply()
  ScalarField pressure_;
  ForcedVelocity mobility_;    ///< of the last apply_mobility; find_inside uses its force
  ScalarField excess_;         ///< of the viscosity, relative, with double layers
  bool knows_excess_ = false;
  VectorField fluid_velocity_;    ///< where it is not the velocity solved for
  SheetVelocity sheets_;
  StokesSolver solver_;
};

}    // namespace fluid
