#pragma once

#include "coupling.h"
#include "plates.h"
#include "stokes_solver.h"

namespace fluid {

/// Global measures of a flow; forces are those the fluid exerts.
struct FlowMeasures {
  double kinetic_energy_per_density = 0;    ///< half the volume integral of u^2
  Vec3 lower_traction{0, 0, 0};    ///< force per area on the lower plate, zero without plates
  Vec3 upper_traction{0, 0, 0};
  Vec3 mean_velocity{0, 0, 0};
  double max_speed = 0;
  double max_divergence = 0;    ///< times the spacing, over max_speed
};

/// Stokes flow around immersed boundaries on this rank's part of the grid. A step is
///   clear_force, spread, solve, interpolate.
class Flow {
 public:
  Flow(const Grid &grid, const Decomposition &decomposition, int ghost_layers, double viscosity);
  Flow(const Flow &) = delete;
  Flow &operator=(const Flow &) = delete;

  Drive drive;

  void clear_force();

  /// Returns the first marker whose kernel leaves the ghost layers (nothing is spread for it), or -1.
  int spread(KernelKind kernel, const Markers &markers, const double *position, const double *force,
             double factor);

  /// Adds the ghosts' share of the force to its owners: the exchange between spread and solve.
  void gather_force();

  void solve();

  /// Fills the ghost layers of the velocity: the exchange between solve and interpolate.
  void share_velocity();

  /// Fills the ghost layers of the force; needed for output only.
  void share_force() { halo_.fill(force_.views()); }

  void interpolate(KernelKind kernel, const Markers &markers, const double *position,
                   double *velocity) const;

  const Grid &grid() const { return grid_; }
  const Box &brick() const { return decomposition_.mine(); }
  const VectorField &force() const { return force_; }
  const VectorField &velocity() const { return velocity_; }
  const ScalarField &pressure();

  /// Collective.
  FlowMeasures measure() const;

  Traffic traffic() const;
  std::size_t bytes() const;

 private:
  void measure_tractions(FlowMeasures &measures) const;

  Grid grid_;
  Decomposition decomposition_;
  double viscosity_;
  Halo halo_;
  VectorField force_, velocity_;
  ScalarField pressure_;
  Vec3 lower_direct_{0, 0, 0},
      upper_direct_{0, 0, 0};    ///< spread force that went straight into a plate
  StokesSolver solver_;
};

}    // namespace fluid
