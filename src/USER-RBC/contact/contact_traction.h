#pragma once

namespace rbc {

/// Normal force (positive where it repels) and energy of a contact, each per area of one surface.
struct ContactTraction {
  double traction, energy;
};

}    // namespace rbc
