#pragma once

namespace fluid {

enum class Inertia {
  none,         ///< steady Stokes flow
  unsteady,     ///< Crank-Nicolson
  convective    ///< Crank-Nicolson, advection by Adams-Bashforth of second order
};

enum class Scheme {
  coupled,      ///< velocity and pressure together, exactly
  projection    ///< a step without continuity, then a projection: incremental, rotational form
};

/// What the equations of motion contain.
struct FlowEquations {
  double viscosity = 1;
  double density = 1;    ///< without inertia not used
  Inertia inertia = Inertia::none;
  Scheme scheme = Scheme::coupled;
  bool hold_mean = true;    ///< triply periodic: by a uniform pressure gradient
};

}    // namespace fluid
