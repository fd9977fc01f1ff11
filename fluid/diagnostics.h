#pragma once

#include "fluid/flow.h"

namespace fluid {

/// Global measures of a flow; forces are those the fluid exerts.
struct FlowDiagnostics {
  double kinetic_energy_per_density = 0;    ///< half the volume integral of u^2
  Real3 lower_traction{0, 0, 0};    ///< force per area on the lower plate, zero without plates
  Real3 upper_traction{0, 0, 0};
  Real3 mean_velocity{0, 0, 0};    ///< of what is solved for
  double max_speed = 0;
  double max_divergence = 0;    ///< times the smallest spacing, over max_speed
};

/// Collective. Fills the ghosts of the velocity if they are not filled. `forcing` must be that of
/// the last solve or, with inertia, of the end of the last step.
FlowDiagnostics diagnose(Flow &flow, const Forcing &forcing);

}    // namespace fluid
